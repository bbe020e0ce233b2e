#include "libguide/directional/expectation_maximization.h"

#include <gtest/gtest.h>

#include "common/stepwise_em.h"
#include "libguide/directional/em_step.h"
#include "libguide/directional/mixture_check.h"
#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

using test::component;
using test::StepwiseEm;

std::vector<GaussianComponent> known() {
  return {component(0.5f, {-0.4f, 0.1f}, 0.1f, 0.05f, 0.5f),
          component(0.3f, {0.5f, 0.4f}, 0.08f, 0.12f, -0.3f),
          component(0.2f, {0.2f, -0.6f}, 0.03f, 0.03f, 0)};
}

std::vector<WeightedPoint> drawn_points(const GaussianMixture& mixture, int count, uint64_t seed) {
  std::vector<WeightedPoint> points;
  for (const Vec2& y : test::draw(mixture, count, seed)) points.push_back({y, 1});
  return points;
}

double difference(const GaussianMixture& a, const GaussianMixture& b) {
  return test::integrate_disk([&](const Vec2& y) { return std::abs(a.pdf(y) - b.pdf(y)); });
}

TEST(FitMixture, RecoversAKnownMixture) {
  const GaussianMixture truth(known());
  EmOptions options;
  options.components = 3, options.max_iterations = 100;
  const EmResult fit = fit_mixture(drawn_points(truth, 8192, 1), options);
  ASSERT_EQ(fit.components.size(), 3u);
  for (const GaussianComponent& expected : known()) {
    const auto found =
        std::min_element(fit.components.begin(), fit.components.end(), [&](auto& a, auto& b) {
          return std::hypot(a.mean_x - expected.mean_x, a.mean_y - expected.mean_y) <
                 std::hypot(b.mean_x - expected.mean_x, b.mean_y - expected.mean_y);
        });
    EXPECT_NEAR(found->weight, expected.weight, 0.01);
    EXPECT_NEAR(found->mean_x, expected.mean_x, 0.005);
    EXPECT_NEAR(found->mean_y, expected.mean_y, 0.005);
    EXPECT_NEAR(found->cov_xx, expected.cov_xx, 0.08f * expected.cov_xx);
    EXPECT_NEAR(found->cov_yy, expected.cov_yy, 0.08f * expected.cov_yy);
  }
  EXPECT_LT(difference(GaussianMixture(fit.components), truth), 0.03);
}

TEST(FitMixture, OverRelaxedIsFurtherInTwoThirdsOfTheIterations) {
  const std::vector<WeightedPoint> points = drawn_points(GaussianMixture(known()), 2048, 4);
  EmOptions plain;
  plain.components = 8, plain.tolerance = 0, plain.max_iterations = 24;
  EmOptions relaxed = plain;
  relaxed.step = 1.8f, relaxed.max_iterations = 16;
  EXPECT_GE(fit_mixture(points, relaxed).log_likelihood, fit_mixture(points, plain).log_likelihood);
}

TEST(FitMixture, OverRelaxedFindsTheSameMixture) {
  const GaussianMixture truth(known());
  const std::vector<WeightedPoint> points = drawn_points(truth, 2048, 4);
  EmOptions options;
  options.components = 3, options.tolerance = 0, options.max_iterations = 200;
  const EmResult plain = fit_mixture(points, options);
  options.step = 1.8f;
  const EmResult relaxed = fit_mixture(points, options);
  EXPECT_LT(difference(GaussianMixture(relaxed.components), GaussianMixture(plain.components)),
            0.001);
}

TEST(FitMixture, OverRelaxedGivesValidComponentsWhateverTheStart) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const std::vector<WeightedPoint> points = drawn_points(GaussianMixture(known()), 40, seed);
    EmOptions options;
    options.step = 1.9f, options.prior.b = 5e-6f;
    options.max_iterations = 1 + static_cast<int>(seed % 32);
    const EmResult fit = fit_mixture(points, options);
    ASSERT_FALSE(fit.components.empty()) << "seed " << seed;
    EXPECT_EQ(check_mixture(fit.components), "") << "seed " << seed;
  }
}

TEST(OverRelax, LeavesACovarianceThatWouldVanishAndKeepsWeightsPositive) {
  const std::vector<GaussianComponent> before = {component(0.02f, {0, 0}, 0.1f, 0.1f, 0),
                                                 component(0.98f, {0, 0}, 0.1f, 0.1f, 0)};
  std::vector<GaussianComponent> after = {component(0.6f, {0.1f, 0}, 0.03f, 0.1f, 0),
                                          component(0.4f, {0, 0.2f}, 0.09f, 0.09f, 0)};
  const std::vector<GaussianComponent> stepped = after;
  over_relax(before, 1.8f, after);
  EXPECT_EQ(check_mixture(after), "");
  EXPECT_EQ(after[0].mean_x, stepped[0].mean_x);
  EXPECT_EQ(after[0].cov_xx, stepped[0].cov_xx);
  EXPECT_NEAR(after[1].mean_y, 0.36f, 1e-6f);
  EXPECT_LT(after[1].cov_xx, stepped[1].cov_xx);
  EXPECT_LT(after[1].weight, stepped[1].weight);
  EXPECT_GT(after[1].weight, 0);
  EXPECT_NEAR(after[0].weight + after[1].weight, 1, 1e-6f);
}

TEST(FitMixture, WeightsOfUniformPointsGiveTheSameMixture) {
  const GaussianMixture truth(known());
  std::vector<WeightedPoint> points;
  for (int i = 0; i < 16384; ++i) {
    const Vec2 y = square_to_disk(Sampler(1, 0, i).next_2d());
    points.push_back({y, truth.pdf(y)});
  }
  EmOptions options;
  options.components = 3, options.max_iterations = 100;
  options.max_weight = kInfinity;  // a peak is no firefly here
  const EmResult fit = fit_mixture(points, options);
  EXPECT_LT(difference(GaussianMixture(fit.components), truth), 0.05);
}

TEST(FitMixture, TheScaleOfTheWeightsDoesNotMatter) {
  auto points = drawn_points(GaussianMixture(known()), 512, 2);
  const EmResult one = fit_mixture(points, {});
  for (WeightedPoint& p : points) p.weight *= 0x1p-60f;
  const EmResult other = fit_mixture(points, {});
  ASSERT_EQ(one.components.size(), other.components.size());
  for (size_t k = 0; k < one.components.size(); ++k)
    EXPECT_EQ(one.components[k].mean_x, other.components[k].mean_x);
}

TEST(FitMixture, MoreIterationsNeverLowerTheLikelihoodMuch) {
  const auto points = drawn_points(GaussianMixture(test::random_components(8, 4)), 4096, 3);
  double previous = -1e30;
  for (int iterations = 1; iterations < 30; ++iterations) {
    EmOptions options;
    options.max_iterations = iterations, options.tolerance = 0;
    const double likelihood = fit_mixture(points, options).log_likelihood;
    EXPECT_GE(likelihood, previous - 1e-4) << iterations;  // the prior may pull it down a little
    previous = likelihood;
  }
}

TEST(StepwiseEm, LearnsAKnownMixtureFromAStream) {
  const GaussianMixture truth(known());
  const auto first = drawn_points(truth, 256, 10);
  StepwiseEm em(initial_components(first, 3, {}), {}, 0);
  float seen = 0;
  for (int batch = 0; batch < 60; ++batch) {
    const auto points = drawn_points(truth, 256, 10 + batch);
    seen += points.size();
    em.update(points, seen, {});
  }
  EXPECT_EQ(em.step(), 60);
  EXPECT_LT(difference(GaussianMixture(em.components()), truth), 0.08);
  float s0 = 0;
  for (const ComponentStatistics& s : em.statistics()) s0 += s.s0;
  EXPECT_NEAR(s0, 1, 1e-4);
}

TEST(StepwiseEm, ContinuesFromItsRecords) {
  const auto a = drawn_points(GaussianMixture(known()), 256, 1);
  const auto b = drawn_points(GaussianMixture(known()), 256, 2);
  StepwiseEm whole(initial_components(a, 4, {}), {}, 0);
  whole.update(a, 256, {});
  StepwiseEm resumed(whole.components(), whole.statistics(), whole.step());
  whole.update(b, 512, {});
  resumed.update(b, 512, {});
  for (size_t k = 0; k < whole.components().size(); ++k)
    EXPECT_EQ(whole.components()[k].cov_xy, resumed.components()[k].cov_xy);
}

TEST(StepwiseEm, FollowsALobeTooNarrowForMomentsAboutTheOrigin) {
  const GaussianMixture truth(std::array{component(1, {0.7f, 0.6f}, 6e-4f, 4e-4f, 0)});
  const auto points = drawn_points(truth, 4096, 1);
  MixturePrior weak;
  weak.b = 1e-8f;
  StepwiseEm em(initial_components(points, 1, weak), {}, 0);
  for (int batch = 0; batch < 20; ++batch) em.update(points, 4096, weak);
  ASSERT_EQ(em.components().size(), 1u);
  EXPECT_NEAR(em.components()[0].cov_xx, 3.6e-7f, 0.3e-7f);
  EXPECT_NEAR(em.components()[0].cov_yy, 1.6e-7f, 0.2e-7f);
}

TEST(InitialComponents, AreDistinctAndAtMostAsManyAsThePoints) {
  const std::vector<WeightedPoint> points = {{{0, 0}, 1}, {{0.5f, 0}, 1}, {{0.5f, 0}, 3}};
  const auto start = initial_components(points, 8, {});
  ASSERT_EQ(start.size(), 2u);
  EXPECT_NE(start[0].mean_x, start[1].mean_x);
  EXPECT_EQ(GaussianMixture(start).count(), 2);
}

}  // namespace
}  // namespace waylight
