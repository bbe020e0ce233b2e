#include "libguide/directional/mixture_refit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "libguide/base/sampler.h"
#include "libguide/directional/gaussian_mixture.h"
#include "libguide/directional/missing_lobe.h"

namespace waylight {
namespace {

const GaussianComponent kWide{1, 0.1f, -0.05f, 0.06f, 0.01f, 0.05f};
const Vec2 kBeam(0.4f, 0.3f);

std::vector<WeightedPoint> points_of(const GaussianComponent& lobe, int count, uint64_t seed = 3) {
  const GaussianMixture mixture(std::span(&lobe, 1));
  std::vector<WeightedPoint> points;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, 0, i);
    const float u = sampler.next();
    if (const auto y = mixture.sample(u, sampler.next_2d())) points.push_back({*y, 1});
  }
  return points;
}

// A wide lobe of 500 points, and a beam of ten within a tenth of a degree.
std::vector<WeightedPoint> points_with_beam() {
  std::vector<WeightedPoint> points = points_of(kWide, 500);
  for (int i = 0; i < 10; ++i)
    points.push_back(
        {kBeam + 5e-4f * Vec2(static_cast<float>(i % 3), static_cast<float>(i % 2)), 1});
  return points;
}

float density(std::span<const GaussianComponent> components, const Vec2& y) {
  return GaussianMixture(components).pdf(y);
}

TEST(MissingLobes, FindABeamOfFewPointsInAWideLobe) {
  const auto lobe = MissingLobes(points_with_beam()).find(std::span(&kWide, 1), {});
  ASSERT_TRUE(lobe);
  EXPECT_NEAR(lobe->mean_x, kBeam.x(), 0.002f);
  EXPECT_NEAR(lobe->mean_y, kBeam.y(), 0.002f);
  EXPECT_NEAR(lobe->weight, 10 / 510.0, 0.003);
  EXPECT_LT(lobe->cov_xx, 1e-4f);
}

TEST(MissingLobes, DoNotTakeAHeavyPointForABeam) {
  std::vector<WeightedPoint> points = points_of(kWide, 500);
  points.push_back({kBeam, 20});
  points.push_back({kBeam, 0.1f});
  const auto lobe = MissingLobes(points).find(std::span(&kWide, 1), {});
  if (lobe) {
    EXPECT_GT((Vec2(lobe->mean_x, lobe->mean_y) - kBeam).norm(), 0.01f);
  }
}

TEST(MissingLobes, FindNothingWithoutValidPoints) {
  EXPECT_FALSE(MissingLobes({}).find(std::span(&kWide, 1), {}));
  const WeightedPoint bad[] = {{Vec2(NAN, 0), 1}, {Vec2(0, 0), -1}, {Vec2(9, 9), 1}};
  EXPECT_FALSE(MissingLobes(bad).find(std::span(&kWide, 1), {}));
}

TEST(RefitMixture, GivesABeamALobeOfItsOwn) {
  const std::vector<WeightedPoint> points = points_with_beam();
  const auto refitted = refit_mixture(points, std::span(&kWide, 1), 8, {}, 0.3f);
  const Vec2 beam = kBeam + Vec2(5e-4f, 2e-4f);
  EXPECT_GT(density(refitted, beam), 50 * density(std::span(&kWide, 1), beam));
  EmOptions em;  // which alone takes the beam for a part of the lobe
  const auto by_em = fit_mixture(points, em, std::span(&kWide, 1)).components;
  EXPECT_LT(density(by_em, beam), 2 * density(std::span(&kWide, 1), beam));
}

TEST(RefitMixture, PutsTheLobeInPlaceOfAnotherWhereThereIsNoRoom) {
  const std::vector<WeightedPoint> points = points_with_beam();
  EmOptions em;
  em.components = 8;
  const auto start = fit_mixture(points_of(kWide, 500), em).components;
  ASSERT_EQ(start.size(), 8u);
  const auto refitted = refit_mixture(points, start, 8, {}, 0.3f);
  EXPECT_LE(refitted.size(), 8u);
  EXPECT_GT(density(refitted, kBeam), 50 * density(start, kBeam));
}

TEST(RefitMixture, HasNoMoreLobesThanItMay) {
  for (const int most : {1, 2}) {
    const auto refitted = refit_mixture(points_with_beam(), std::span(&kWide, 1), most, {}, 0.3f);
    EXPECT_EQ(refitted.size(), static_cast<size_t>(most));
  }
}

// Two wide lobes a little off: EM has yet to gain, a lobe more has not.
TEST(RefitMixture, GivesALobeNoCreditForWhatEmGainsAnyway) {
  GaussianComponent other = kWide;
  other.mean_x = -0.5f;
  GaussianComponent start[] = {kWide, other};
  for (GaussianComponent& c : start) c.mean_y += 0.15f, c.cov_xx *= 2, c.weight = 0.5f;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<WeightedPoint> points = points_of(kWide, 200, seed);
    for (const WeightedPoint& p : points_of(other, 200, seed + 100)) points.push_back(p);
    EXPECT_EQ(refit_mixture(points, start, 8, {}, 0.3f).size(), 2u) << "seed " << seed;
  }
}

TEST(RefitMixture, AddsNoLobeToPointsOfTheMixtureItself) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const auto refitted =
        refit_mixture(points_of(kWide, 400, seed), std::span(&kWide, 1), 8, {}, 0.3f);
    EXPECT_EQ(refitted.size(), 1u) << "seed " << seed;
  }
}

TEST(RefitMixture, KeepsTheMixtureWithoutValidPoints) {
  const WeightedPoint bad{Vec2(0, 0), -1};
  const auto refitted = refit_mixture(std::span(&bad, 1), std::span(&kWide, 1), 8, {}, 0.3f);
  ASSERT_EQ(refitted.size(), 1u);
  EXPECT_EQ(refitted[0].mean_x, kWide.mean_x);
}

}  // namespace
}  // namespace waylight
