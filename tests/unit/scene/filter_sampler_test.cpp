#include <gtest/gtest.h>

#include "libguide/base/error.h"
#include "libguide/scene/camera.h"

namespace waylight {
namespace {

FilmDescription film(FilterType type, float radius = 0) {
  FilmDescription result;
  result.filter = type;
  result.filter_radius = radius;
  return result;
}

// Mean of sign * g(offset along the axis), the other axis held at its centre, where filters are
// positive. The filter is separable: the mean over both axes is a product of two of these.
template <typename G>
double signed_mean(const FilterSampler& filter, int axis, const G& g) {
  constexpr int kCount = 1 << 16;
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    Vec2 u(0.5f, 0.5f);
    u[axis] = (i + 0.5f) / kCount;
    const FilterSampler::Sample s = filter.sample(u);
    sum += (s.weight < 0 ? -1 : 1) * g(s.offset[axis]);
  }
  return sum / kCount;
}

double one(double) { return 1; }
double square(double x) { return x * x; }

// Second moments of the separable filters, by hand.
struct Case {
  FilterType type;
  double second_moment;
};

class FilterSamplerTest : public testing::TestWithParam<Case> {};

TEST_P(FilterSamplerTest, WeightsAverageToOne) {
  const FilterSampler filter(film(GetParam().type));
  const double weight = std::abs(filter.sample({0.5f, 0.5f}).weight);
  EXPECT_NEAR(weight * signed_mean(filter, 0, one) * signed_mean(filter, 1, one), 1, 1e-3);
}

TEST_P(FilterSamplerTest, MomentsAreThoseOfTheFilter) {
  const FilterSampler filter(film(GetParam().type));
  for (const int axis : {0, 1}) {
    const double total = signed_mean(filter, axis, one);
    EXPECT_NEAR(signed_mean(filter, axis, [](double x) { return x; }) / total, 0, 1e-3);
    EXPECT_NEAR(signed_mean(filter, axis, square) / total, GetParam().second_moment, 1e-3);
  }
}

TEST_P(FilterSamplerTest, OffsetsStayWithinTheRadius) {
  const FilterSampler filter(film(GetParam().type, 3));
  for (const float u : {0.0f, 1e-7f, 0.5f, kOneMinusEpsilon})
    EXPECT_LE(filter.sample({u, u}).offset.cwiseAbs().maxCoeff(), 3);
}

// Gaussian of deviation 0.5 lowered by exp(-8) to end at 2; Mitchell-Netravali with B = C = 1/3.
double by_quadrature(FilterType type) {
  double m0 = 0, m2 = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = (i + 0.5) / 100000, x2 = x * x, x3 = x2 * x;
    double f = 0;
    if (type == FilterType::gaussian) f = std::exp(-2 * x2) - std::exp(-8.0);
    if (type == FilterType::mitchell)
      f = x < 1 ? 7 * x3 - 12 * x2 + 16.0 / 3 : -7.0 / 3 * x3 + 12 * x2 - 20 * x + 32.0 / 3;
    m0 += f;
    m2 += f * x2;
  }
  return m2 / m0;
}

INSTANTIATE_TEST_SUITE_P(
    AllFilters, FilterSamplerTest,
    testing::Values(Case{FilterType::box, 0.25 / 3}, Case{FilterType::tent, 1.0 / 6},
                    Case{FilterType::gaussian, by_quadrature(FilterType::gaussian)},
                    Case{FilterType::mitchell, by_quadrature(FilterType::mitchell)}));

TEST(FilterSampler, MitchellCarriesItsNegativeLobes) {
  const FilterSampler filter(film(FilterType::mitchell));
  int negative = 0;
  for (int i = 0; i < 1000; ++i) {
    const FilterSampler::Sample s = filter.sample({(i + 0.5f) / 1000, 0.5f});
    negative += s.weight < 0;
    // The kernel crosses zero at 8/7 pixel for B = C = 1/3.
    EXPECT_EQ(s.weight<0, std::abs(s.offset.x())> 8.0f / 7) << s.offset.x();
  }
  EXPECT_GT(negative, 10);
}

TEST(FilterSampler, RefusesAFilterOfNoWidth) {
  FilmDescription f = film(FilterType::gaussian);
  f.filter_stddev = 0;
  EXPECT_THROW(FilterSampler{f}, Error);
}

}  // namespace
}  // namespace waylight
