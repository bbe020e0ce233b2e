#include "libguide/directional/gaussian_mixture.h"

#include <gtest/gtest.h>

#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

using test::component;
using test::integrate_disk;
using test::random_components;

TEST(GaussianMixture, DensityIsTheSumOfItsComponents) {
  const auto components = random_components(8, 1);
  double total = 0;
  for (const auto& c : components) total += c.weight;
  const GaussianMixture mixture(components);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 y = 1.4f * square_to_disk(Sampler(2, 0, i).next_2d());
    double expected = 0;
    for (const auto& c : components) expected += c.weight / total * test::density(c, y);
    EXPECT_NEAR(mixture.pdf(y), expected, 2e-5 * expected + 1e-9) << y.transpose();
  }
}

TEST(GaussianMixture, IntegratesToItsMassInside) {
  for (int count = 1; count <= 8; ++count) {
    const GaussianMixture mixture(random_components(count, 10 + count));
    const double integral = integrate_disk([&](const Vec2& y) { return mixture.pdf(y); });
    EXPECT_NEAR(integral, mass_inside(mixture), 0.003) << count;
    EXPECT_LE(integral, 1.0001);
  }
}

TEST(GaussianMixture, SamplesFollowTheDensity) {
  for (int count : {1, 3, 8}) {
    const GaussianMixture mixture(random_components(count, 20 + count));
    const int drawn = 1 << 16;
    const auto points = test::draw(mixture, drawn, count);
    const auto pdf = [&](const Vec2& y) { return mixture.pdf(y); };
    EXPECT_LT(test::worst_cell_deviation(points, drawn, pdf), 3.5) << count;
    EXPECT_NEAR(double(points.size()) / drawn, integrate_disk(pdf), 0.003) << count;
  }
}

TEST(GaussianMixture, DensityAndSamplesEndAtTheRim) {
  const GaussianMixture mixture(std::array{component(1, {1.3f, 0}, 0.2f, 0.2f, 0)});
  EXPECT_EQ(mixture.pdf(Vec2(1.42f, 0)), 0);
  EXPECT_EQ(mixture.pdf(Vec2(std::nanf(""), 0)), 0);
  EXPECT_GT(mixture.pdf(Vec2(1.41f, 0)), 0);
  const auto points = test::draw(mixture, 4096, 1);
  EXPECT_LT(points.size(), 4096 * 0.8);
  for (const Vec2& y : points) EXPECT_LE(y.squaredNorm(), kDiskMaxRadius2);
}

TEST(GaussianMixture, LeavesOutWhatIsNotAGaussian) {
  const float nan = std::nanf("");
  const GaussianComponent good = component(2, {0.1f, 0.2f}, 0.1f, 0.2f, 0.5f);
  std::vector<GaussianComponent> bad(10, good);
  bad[0].weight = 0, bad[1].weight = -1, bad[2].weight = kInfinity, bad[3].weight = nan;
  bad[4].mean_x = nan, bad[5].mean_y = kInfinity, bad[6].cov_xx = 0, bad[7].cov_yy = nan;
  bad[8].cov_xy = 0.021f, bad[9].cov_xx = -1;
  const GaussianMixture none(bad);
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.pdf(Vec2(0.1f, 0.2f)), 0);
  EXPECT_FALSE(none.sample(0.5f, Vec2(0.5f, 0.5f)));
  bad.push_back(good);
  const GaussianMixture one(bad);
  ASSERT_EQ(one.count(), 1);
  EXPECT_EQ(one.component(0).weight, 1);
  EXPECT_NEAR(one.pdf(Vec2(0.1f, 0.2f)), test::density(good, Vec2(0.1f, 0.2f)), 1e-3);
}

TEST(GaussianMixture, NarrowLobesKeepTheFloorAndSampleWhatTheyEvaluate) {
  // Elongated 1:1000 across both axes: the quadratic form of the inverse would cancel here.
  const GaussianMixture mixture(
      std::array{GaussianComponent{1, 0.5f, 0.5f, 0.05f, 0.05f - 1e-8f, 0.05f}});
  ASSERT_EQ(mixture.count(), 1);
  double mean_ratio = 0;
  int inside = 0;
  for (int i = 0; i < 4096; ++i) {
    const auto y = mixture.sample(0, Sampler(1, 1, i).next_2d());
    if (!y) continue;
    const float across = (y->x() - y->y()) * std::sqrt(0.5f);
    mean_ratio += sqr(across) / kCovarianceFloor;
    ++inside;
    EXPECT_GT(mixture.pdf(*y), 0);
  }
  EXPECT_NEAR(mean_ratio / inside, 1, 0.15);
}

// Turned so that they lie along the y axis, long lobes lose the variance along x to rounding.
TEST(GaussianMixture, LongLobesTurnedUprightKeepAFiniteDensity) {
  for (int i = 0; i < 20'000; ++i) {
    Sampler sampler(6, 0, i);
    const float xx = 100 + sampler.next(), yy = 100 + sampler.next(), xy = std::sqrt(xx * yy);
    const float upright = kPi / 2 - 0.5f * std::atan2(2 * xy, xx - yy);
    const GaussianMixture mixture(std::array{GaussianComponent{1, 0, 0, xx, xy * (1 - 1e-7f), yy}},
                                  Vec2(std::cos(upright), std::sin(upright)));
    if (mixture.count() == 0) continue;
    EXPECT_TRUE(std::isfinite(mixture.pdf(Vec2(0, 0)))) << xx << " " << yy;
    const auto y = mixture.sample(0.5f, sampler.next_2d());
    EXPECT_TRUE(!y || mixture.pdf(*y) > 0) << xx << " " << yy;
  }
}

TEST(GaussianMixture, RotationOfThePlaneRotatesTheDensity) {
  const auto components = random_components(5, 3);
  const GaussianMixture plain(components), turned(components, Vec2(0.6f, -0.8f));
  for (int i = 0; i < 200; ++i) {
    const Vec2 y = square_to_disk(Sampler(5, 0, i).next_2d());
    const Vec2 z(0.6f * y.x() + 0.8f * y.y(), -0.8f * y.x() + 0.6f * y.y());
    EXPECT_NEAR(turned.pdf(z), plain.pdf(y), 1e-4f * plain.pdf(y) + 1e-6f);
  }
}

}  // namespace
}  // namespace waylight
