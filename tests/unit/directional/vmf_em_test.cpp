#include "libguide/directional/vmf_em.h"

#include <gtest/gtest.h>

#include <array>

#include "libguide/directional/vmf_em_step.h"
#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

std::vector<VmfComponent> known() {
  return {{0.5f, Vec3(1, 0.2f, 0.1f).normalized(), 20},
          {0.3f, Vec3(-0.5f, 0.8f, 0.3f).normalized(), 6},
          {0.2f, Vec3(0, -0.4f, -0.9f).normalized(), 150}};
}

double difference(const std::vector<VmfComponent>& a, const std::vector<VmfComponent>& b) {
  const VmfMixture x(a), y(b);
  return test::integrate_sphere([&](const Vec3& w) { return std::abs(x.pdf(w) - y.pdf(w)); });
}

TEST(FitVmfMixture, RecoversAKnownMixture) {
  VmfEmOptions options;
  options.components = 3, options.max_iterations = 100;
  const VmfEmResult fit = fit_vmf_mixture(test::draw(VmfMixture(known()), 8192, 1), options);
  ASSERT_EQ(fit.components.size(), 3u);
  for (const VmfComponent& expected : known()) {
    const auto found = std::max_element(
        fit.components.begin(), fit.components.end(),
        [&](auto& a, auto& b) { return a.mean.dot(expected.mean) < b.mean.dot(expected.mean); });
    EXPECT_NEAR(found->weight, expected.weight, 0.01);
    EXPECT_GT(found->mean.dot(expected.mean), 0.9998);
    EXPECT_NEAR(found->kappa, expected.kappa, 0.06f * expected.kappa);
  }
  EXPECT_LT(difference(fit.components, known()), 0.03);
}

TEST(FitVmfMixture, WeightsOfUniformDirectionsGiveTheSameMixture) {
  std::vector<WeightedDirection> points;
  const VmfMixture truth(known());
  for (int i = 0; i < 16384; ++i) {
    const Vec3 w = square_to_sphere(Sampler(1, 0, i).next_2d());
    points.push_back({w, truth.pdf(w)});
  }
  VmfEmOptions options;
  options.max_iterations = 100;    // of eight lobes: three may start in the wrong places
  options.max_weight = kInfinity;  // a peak is no firefly here
  EXPECT_LT(difference(fit_vmf_mixture(points, options).components, known()), 0.05);
}

TEST(FitVmfMixture, TheScaleOfTheWeightsDoesNotMatter) {
  auto points = test::draw(VmfMixture(known()), 512, 2);
  const VmfEmResult one = fit_vmf_mixture(points, {});
  for (WeightedDirection& p : points) p.weight *= 0x1p-60f;
  const VmfEmResult other = fit_vmf_mixture(points, {});
  ASSERT_EQ(one.components.size(), other.components.size());
  for (size_t k = 0; k < one.components.size(); ++k)
    EXPECT_EQ(one.components[k].mean, other.components[k].mean);
}

TEST(FitVmfMixture, MoreIterationsNeverLowerTheLikelihoodMuch) {
  const auto points = test::draw(VmfMixture(test::random_lobes(8, 4)), 4096, 3);
  double previous = -1e30;
  for (int iterations = 1; iterations < 30; ++iterations) {
    VmfEmOptions options;
    options.max_iterations = iterations, options.tolerance = 0;
    const double likelihood = fit_vmf_mixture(points, options).log_likelihood;
    EXPECT_GE(likelihood, previous - 1e-4) << iterations;  // the prior may pull it down a little
    previous = likelihood;
  }
}

TEST(FitVmfMixture, LikelihoodIsThatOfTheMixtureBeforeTheLastStep) {
  const auto points = test::draw(VmfMixture(known()), 500, 3);
  VmfEmOptions options;
  options.max_iterations = 1;
  const std::vector<VmfComponent> start = test::random_lobes(5, 8);
  double expected = 0, total = 0;
  for (const VmfComponent& c : start) total += c.weight;
  for (const WeightedDirection& p : points)
    expected += std::log(test::density(start, p.w) * total) / points.size();
  EXPECT_NEAR(fit_vmf_mixture(points, options, start).log_likelihood, expected, 1e-4);
}

TEST(FitVmfMixture, KeepsTheResultantWithoutPriors) {
  const auto points = test::draw(VmfMixture(known()), 2000, 6);
  Vec3 mean = Vec3::Zero();
  for (const WeightedDirection& p : points) mean += p.w / points.size();
  VmfEmOptions options;
  options.prior = {1, 0, 0};
  Vec3 resultant = Vec3::Zero();
  for (const VmfComponent& c : fit_vmf_mixture(points, options).components)
    resultant += statistics_of(c).s1;
  EXPECT_LT((resultant - mean).norm(), 1e-5);
}

TEST(StepwiseVmf, LearnsAKnownMixtureFromAStream) {
  const VmfMixture truth(known());
  auto components = initial_vmf_components(test::draw(truth, 256, 10), 3, {});
  std::vector<VmfStatistics> statistics(components.size());
  float step = 0, seen = 0;
  for (int batch = 0; batch < 60; ++batch) {
    const auto points = test::draw(truth, 256, 10 + batch);
    seen += points.size();
    ASSERT_EQ(stepwise_vmf_update(components, statistics, step, points, seen, {}).count, 3);
  }
  EXPECT_EQ(step, 60);
  EXPECT_LT(difference(components, known()), 0.08);
  float s0 = 0;
  for (const VmfStatistics& s : statistics) s0 += s.s0;
  EXPECT_NEAR(s0, 1, 1e-4);
}

TEST(StepwiseVmf, IsBlockwiseTheSameAsOneStepOfTheBatch) {
  const auto points = test::draw(VmfMixture(known()), 1000, 3);  // no whole number of blocks
  const std::vector<VmfComponent> start = initial_vmf_components(points, 5, {});
  VmfEmOptions options;
  options.max_iterations = 1;
  const auto batch = fit_vmf_mixture(points, options, start).components;
  auto components = start;
  std::vector<VmfStatistics> statistics(components.size());
  float step = 0;
  stepwise_vmf_update(components, statistics, step, points, points.size(), {});
  for (size_t k = 0; k < batch.size(); ++k) EXPECT_EQ(components[k].kappa, batch[k].kappa);
}

TEST(StepwiseVmf, ForgetsLobesWithoutSupport) {
  std::vector<VmfComponent> components = {{0.5f, Vec3::UnitX(), 1e3f}, {0.5f, Vec3::UnitZ(), 1e3f}};
  std::vector<VmfStatistics> statistics(2);
  float step = 0;
  const std::vector<WeightedDirection> points(100, {Vec3::UnitZ(), 1});
  EXPECT_EQ(stepwise_vmf_update(components, statistics, step, points, 100, {}).count, 1);
  EXPECT_EQ(components[0].mean, Vec3::UnitZ());
  EXPECT_FLOAT_EQ(statistics[0].s0, 1);
}

TEST(StepwiseVmf, FollowsANarrowLobe) {
  const std::vector<VmfComponent> truth = {{1, Vec3(0.3f, 0.4f, -0.8f).normalized(), 2e4f}};
  const auto points = test::draw(VmfMixture(truth), 4096, 1);
  const VmfPrior weak = {1.01f, 1e-4f, 0};
  auto components = initial_vmf_components(points, 1, weak);
  std::vector<VmfStatistics> statistics(1);
  float step = 0;
  for (int batch = 0; batch < 20; ++batch)
    stepwise_vmf_update(components, statistics, step, points, 4096, weak);
  EXPECT_NEAR(components[0].kappa, 2e4f, 1e3f);
  EXPECT_LT((components[0].mean - truth[0].mean).norm(), 3e-4f);
}

TEST(InitialVmf, AreDistinctAndAtMostAsManyAsTheDirections) {
  const std::vector<WeightedDirection> points = {
      {Vec3::UnitX(), 1}, {Vec3::UnitY(), 1}, {Vec3::UnitY(), 3}};
  const auto start = initial_vmf_components(points, 8, {});
  ASSERT_EQ(start.size(), 2u);
  EXPECT_NE(start[0].mean, start[1].mean);
  EXPECT_EQ(VmfMixture(start).count(), 2);
}

struct Grown {
  std::array<VmfComponent, 8> components{};
  std::array<VmfStatistics, 8> statistics{};
};

TEST(VmfGrowth, KeepsWeightAndResultantOfTheMixture) {
  Grown g;
  g.components[0] = {0.7f, Vec3(0.1f, 0.5f, 0.3f).normalized(), 3};
  g.components[1] = {0.3f, -Vec3::UnitZ(), 40};
  const Vec3 before = statistics_of(g.components[0]).s1 + statistics_of(g.components[1]).s1;
  ASSERT_EQ(grow_vmf_mixture(g.components, g.statistics, 2, 8), 8);
  Vec3 after = Vec3::Zero();
  float weight = 0;
  for (const VmfComponent& c : g.components) after += statistics_of(c).s1, weight += c.weight;
  EXPECT_LT((after - before).norm(), 1e-5f);
  EXPECT_NEAR(weight, 1, 1e-6);
}

TEST(VmfGrowth, HalvesStandApartAndCarryTheirStatistics) {
  for (float kappa : {0.0f, 1.0f, 1e4f}) {
    Grown g;
    g.components[0] = {1, Vec3::UnitY(), kappa};
    ASSERT_EQ(grow_vmf_mixture(g.components, g.statistics, 1, 8), 8);
    for (size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(g.statistics[i].s0, g.components[i].weight);
      EXPECT_NEAR(g.components[i].mean.norm(), 1, 1e-6);
      for (size_t j = 0; j < i; ++j)
        EXPECT_GT((g.components[i].mean - g.components[j].mean).norm() * std::sqrt(1 + kappa),
                  0.1f);
    }
    EXPECT_EQ(VmfMixture(g.components).count(), 8);
  }
}

TEST(VmfGrowth, LeavesAFullOrAnEmptyMixtureAlone) {
  Grown g;
  EXPECT_EQ(grow_vmf_mixture(g.components, g.statistics, 0, 8), 0);
  EXPECT_EQ(grow_vmf_mixture(g.components, g.statistics, 8, 4), 8);
}

}  // namespace
}  // namespace waylight
