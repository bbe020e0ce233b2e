#include "libguide/directional/gaussian_product.h"

#include <gtest/gtest.h>

#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

using test::component;
using test::integrate_disk;
using test::random_components;

// The product mixture written out, [Herholz et al. 2016]; unnormalised.
double brute_force(const GaussianMixture& f, const GaussianMixture& l, const Vec2& y) {
  double sum = 0;
  for (int i = 0; i < f.count(); ++i)
    for (int j = 0; j < l.count(); ++j)
      sum += double(f.component(i).weight) * l.component(j).weight *
             test::density(f.component(i), y) * test::density(l.component(j), y);
  return sum;
}

double brute_force_z(const GaussianMixture& f, const GaussianMixture& l) {
  double z = 0;
  for (int i = 0; i < f.count(); ++i)
    for (int j = 0; j < l.count(); ++j) {
      const GaussianComponent a = f.component(i), b = l.component(j);
      const GaussianComponent sum = {
          1, b.mean_x, b.mean_y, a.cov_xx + b.cov_xx, a.cov_xy + b.cov_xy, a.cov_yy + b.cov_yy};
      z += double(a.weight) * b.weight * test::density(sum, Vec2(a.mean_x, a.mean_y));
    }
  return z;
}

TEST(GaussianProduct, EqualsTheProductMixtureWrittenOut) {
  for (auto [k_f, k_l] : {std::pair{1, 1}, {2, 4}, {4, 2}, {8, 8}}) {
    const GaussianMixture f(random_components(k_f, 30 + k_f)), l(random_components(k_l, 60 + k_l));
    const GaussianProduct product(f, l);
    ASSERT_TRUE(product.valid());
    const double z = brute_force_z(f, l);
    EXPECT_NEAR(product.z(), z, 1e-5 * z);
    for (int i = 0; i < 200; ++i) {
      const Vec2 y = square_to_disk(Sampler(4, 0, i).next_2d());
      const double expected = brute_force(f, l, y) / z;
      EXPECT_NEAR(product.pdf(y), expected, 1e-4 * expected + 1e-6);
    }
  }
}

TEST(GaussianProduct, SamplesFollowTheDensityAndOnlyWhatLeavesIsLost) {
  for (auto [k_f, k_l] : {std::pair{2, 4}, {8, 8}, {5, 1}}) {
    const GaussianMixture f(random_components(k_f, 40 + k_f)), l(random_components(k_l, 70 + k_l));
    const GaussianProduct product(f, l);
    const int drawn = 1 << 16;
    std::vector<Vec2> points;
    for (int i = 0; i < drawn; ++i) {
      Sampler s(9, 0, i);
      const float u = s.next();
      if (const auto y = product.sample(u, s.next_2d())) points.push_back(*y);
    }
    const auto pdf = [&](const Vec2& y) { return product.pdf(y); };
    EXPECT_LT(test::worst_cell_deviation(points, drawn, pdf), 3.5) << k_f << " " << k_l;
    EXPECT_NEAR(integrate_disk(pdf), double(points.size()) / drawn, 0.003);
  }
}

TEST(GaussianProduct, TheOrderOfTheMixturesDoesNotMatter) {
  const GaussianMixture f(random_components(2, 1)), l(random_components(7, 2));
  const GaussianProduct one(f, l), other(l, f);
  EXPECT_EQ(one.z(), other.z());
  for (int i = 0; i < 100; ++i) {
    Sampler s(3, 0, i);
    const float u = s.next();
    const Vec2 u2 = s.next_2d();
    const auto a = one.sample(u, u2), b = other.sample(u, u2);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(*a, *b);
    }
  }
}

TEST(GaussianProduct, LobesThatDoNotMeetAreInvalidInsteadOfInfinite) {
  const GaussianMixture left(std::array{component(1, {-0.7f, 0}, 0.01f, 0.01f, 0)});
  const GaussianMixture right(std::array{component(1, {0.7f, 0}, 0.01f, 0.01f, 0)});
  const GaussianProduct apart(left, right);
  EXPECT_FALSE(apart.valid());
  EXPECT_EQ(apart.z(), 0);
  EXPECT_FALSE(GaussianProduct(left, GaussianMixture()).valid());
  // 9 standard deviations of the difference apart: tiny, but still exact.
  const GaussianMixture near(std::array{component(1, {-0.7f + 0.1273f, 0}, 0.01f, 0.01f, 0)});
  const GaussianProduct touching(left, near);
  ASSERT_TRUE(touching.valid());
  const double integral =
      integrate_disk([&](const Vec2& y) { return touching.pdf(y); }, kDiskMaxRadius2, 2000);
  EXPECT_NEAR(integral, 1, 0.005);
}

TEST(GaussianProduct, NarrowElongatedLobesStillIntegrateToOne) {
  const GaussianMixture a(std::array{component(1, {0.1f, 0.1f}, 0.2f, 0.2f, 0.9998f)});
  const GaussianMixture b(std::array{component(1, {0.2f, 0.19f}, 0.1f, 0.1f, 0.9995f)});
  const GaussianProduct product(a, b);
  ASSERT_TRUE(product.valid());
  double mean = 0;  // importance sampling of a known integral: the brute-force product itself
  const double z = brute_force_z(a, b);
  const int count = 4096;
  for (int i = 0; i < count; ++i) {
    const auto y = product.sample(0.5f, Sampler(2, 2, i).next_2d());
    ASSERT_TRUE(y);
    mean += brute_force(a, b, *y) / z / product.pdf(*y) / count;
  }
  EXPECT_NEAR(mean, 1, 2e-3);
}

}  // namespace
}  // namespace waylight
