// F1, F2, F3 of the stability cases: degenerate, corrupt and extreme input of the trainer.

#include <gtest/gtest.h>

#include "common/stepwise_em.h"
#include "libguide/directional/expectation_maximization.h"
#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

using test::StepwiseEm;
using Points = std::vector<WeightedPoint>;

// Fits the points in batch and as a stream, and returns both, each checked to be a valid mixture
// whose density is finite everywhere.
std::vector<std::vector<GaussianComponent>> fits(const Points& points) {
  StepwiseEm em(initial_components(points, 8, {}), {}, 0);
  for (int i = 1; i <= 10; ++i) em.update(points, static_cast<float>(i * points.size()), {});
  return {fit_mixture(points, {}).components, em.components()};
}

void expect_valid(const std::vector<GaussianComponent>& components) {
  const GaussianMixture mixture(components);
  ASSERT_EQ(mixture.count(), static_cast<int>(components.size()));
  ASSERT_GT(mixture.count(), 0);
  for (int i = 0; i < 256; ++i) {
    const Vec2 y = 1.4142f * square_to_disk(Sampler(1, 0, i).next_2d());
    const float pdf = mixture.pdf(y);
    EXPECT_TRUE(std::isfinite(pdf) && pdf >= 0) << pdf;
  }
}

float smallest_variance(const GaussianComponent& c) {
  const float mean = 0.5f * (c.cov_xx + c.cov_yy);
  return mean - std::hypot(0.5f * (c.cov_xx - c.cov_yy), c.cov_xy);
}

TEST(DegenerateSamples, OneSampleGivesOneLobeOfThePriorsWidth) {
  for (const auto& components : fits({{{0.3f, -0.2f}, 2}})) {
    expect_valid(components);
    ASSERT_EQ(components.size(), 1u);
    EXPECT_NEAR(components[0].mean_x, 0.3f, 1e-6);
    EXPECT_GE(smallest_variance(components[0]), 4e-5f);  // b / 11 after ten updates
    EXPECT_LE(components[0].cov_xx, 5e-4f);
  }
}

TEST(DegenerateSamples, EqualSamplesGiveOneLobeThatStaysAboveTheFloor) {
  for (const auto& components : fits(Points(1000, {{0.3f, -0.2f}, 1}))) {
    expect_valid(components);
    ASSERT_EQ(components.size(), 1u);
    const GaussianMixture mixture(components);  // which adds the floor
    EXPECT_LE(mixture.pdf({components[0].mean_x, components[0].mean_y}),
              0.5f * kInvPi / kCovarianceFloor);
  }
}

TEST(DegenerateSamples, FewerDistinctSamplesThanComponentsGiveAtMostAsManyLobes) {
  Points points;
  for (int i = 0; i < 300; ++i) points.push_back({Vec2(0.4f * (i % 3) - 0.4f, 0.1f), 1});
  for (const auto& components : fits(points)) {
    expect_valid(components);
    EXPECT_EQ(components.size(), 3u);
  }
}

TEST(DegenerateSamples, CollinearSamplesKeepAWidthAcrossTheLine) {
  Points points;
  for (int i = 0; i < 2000; ++i) points.push_back({Vec2(i / 2000.0f, 0.5f * i / 2000.0f), 1});
  for (const auto& components : fits(points)) {
    expect_valid(components);
    for (const GaussianComponent& c : components) EXPECT_GT(smallest_variance(c), 1e-8f);
  }
}

TEST(DegenerateSamples, NoSampleOrNoWeightGivesNoMixture) {
  EXPECT_TRUE(fit_mixture({}, {}).components.empty());
  const Points weightless(10, {{0.1f, 0.1f}, 0});
  EXPECT_TRUE(fit_mixture(weightless, {}).components.empty());
  StepwiseEm em({test::component(1, {0, 0}, 0.1f, 0.1f, 0)}, {}, 0);
  em.update(weightless, 10, {});
  EXPECT_EQ(em.step(), 0);
  EXPECT_EQ(em.components()[0].cov_xx, 0.1f * 0.1f);
}

Points ordinary(int count) {
  Points points;
  const GaussianMixture truth(test::random_components(4, 2));
  for (const Vec2& y : test::draw(truth, count, 1)) points.push_back({y, 1});
  return points;
}

TEST(CorruptSamples, AreWithoutInfluence) {
  const Points good = ordinary(2000);
  Points bad = good;
  const float nan = std::nanf("");
  for (const WeightedPoint& p : {WeightedPoint{{0, 0}, nan},
                                 {{0, 0}, -1},
                                 {{0, 0}, kInfinity},
                                 {{nan, 0}, 1},
                                 {{0, kInfinity}, 1},
                                 {{1.3f, 1.3f}, 1}})
    bad.push_back(p);
  const EmResult clean = fit_mixture(good, {}), dirty = fit_mixture(bad, {});
  ASSERT_EQ(clean.components.size(), dirty.components.size());
  for (size_t k = 0; k < clean.components.size(); ++k)
    EXPECT_EQ(clean.components[k].mean_x, dirty.components[k].mean_x);
  for (const auto& components : fits(bad)) expect_valid(components);
}

double mass_near(const GaussianMixture& mixture, const Vec2& centre, float radius) {
  return test::integrate_disk(
      [&](const Vec2& y) { return (y - centre).norm() <= radius ? mixture.pdf(y) : 0.0f; });
}

TEST(CorruptSamples, OneFireflyAmongManyIsBounded) {
  Points points = ordinary(10000);
  const Vec2 place(-0.05f, 0.95f);
  const double before = mass_near(GaussianMixture(fit_mixture(points, {}).components), place, 0.1f);
  points.push_back({place, 1e30f});
  for (const auto& components : fits(points)) {
    expect_valid(components);
    // A share of 32 / 10000 at most.
    EXPECT_LT(mass_near(GaussianMixture(components), place, 0.1f), before + 0.005);
  }
}

TEST(CorruptSamples, InASmallBatchAFireflyWeighsNoMoreThanAllOthersTogether) {
  Points points;
  for (int i = 0; i < 10; ++i) points.push_back({Vec2(-0.5f, 0.01f * i), 1});
  points.push_back({Vec2(0.5f, 0), 1e30f});
  for (const auto& components : fits(points)) {
    expect_valid(components);
    EXPECT_LT(mass_near(GaussianMixture(components), Vec2(0.5f, 0), 0.3f), 0.55);
  }
}

TEST(ExtremeSamples, HugeAndTinyWeightsDoNotOverflow) {
  for (float scale : {1e-38f, 1e30f}) {
    Points points = ordinary(1000);
    for (WeightedPoint& p : points) p.weight *= scale;
    for (const auto& components : fits(points)) expect_valid(components);
  }
}

TEST(ExtremeSamples, CollimatedLightEndsAtTheWidthThatThePriorAllows) {
  Points points(100000, {{0.6f, 0.3f}, 1});
  for (const auto& components : fits(points)) {
    expect_valid(components);
    const GaussianMixture mixture(components);
    EXPECT_TRUE(std::isfinite(mixture.pdf(Vec2(0.6f, 0.3f))));
    EXPECT_GE(smallest_variance(mixture.component(0)), 0.99f * kCovarianceFloor);
  }
}

TEST(ExtremeSamples, LightAtTheRimLosesMassThatIsReported) {
  Points points;
  for (int i = 0; i < 4000; ++i) {
    const float phi = 2 * kPi * (i + 0.5f) / 4000;
    points.push_back({Vec2(std::cos(phi), std::sin(phi)), 1});
  }
  for (const auto& components : fits(points)) {
    expect_valid(components);
    const GaussianMixture mixture(components);
    EXPECT_GT(mass_inside(mixture), 0.999f);  // nothing of it reaches the pole below
    const float upper = mass_inside(mixture, 1);
    EXPECT_GT(upper, 0.3f);  // about half lies below the horizon
    EXPECT_LT(upper, 0.7f);
  }
}

}  // namespace
}  // namespace waylight
