#include "libguide/directional/vmf_reduction.h"

#include <gtest/gtest.h>

#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

using test::random_lobes;

Vec3 resultant(const std::vector<VmfComponent>& components) {
  Vec3 sum = Vec3::Zero();
  for (const VmfComponent& c : components) sum += statistics_of(c).s1;
  return sum;
}

TEST(VmfMerge, KeepsWeightAndResultant) {
  const auto c = random_lobes(2, 1);
  const VmfComponent m = merge(c[0], c[1]);
  EXPECT_NEAR(m.weight, c[0].weight + c[1].weight, 1e-6);
  EXPECT_LT((resultant({m}) - resultant(c)).norm(), 1e-6);
  EXPECT_NEAR(m.mean.norm(), 1, 1e-6);
}

TEST(VmfMerge, OfOppositeLobesIsUniform) {
  const VmfComponent m = merge({1, Vec3::UnitX(), 9}, {1, -Vec3::UnitX(), 9});
  EXPECT_EQ(m.kappa, 0);
  EXPECT_NEAR(m.mean.norm(), 1, 1e-6);
}

TEST(VmfMerge, EntropyIsThatOfTheDensity) {
  for (float kappa : {0.0f, 1e-5f, 0.3f, 2.0f, 20.0f}) {
    const VmfComponent c = {1, Vec3::UnitZ(), kappa};
    const double entropy = test::integrate_sphere([&](const Vec3& w) {
      const double p = test::density(c, w);
      return p > 0 ? -p * std::log(p) : 0.0;
    });
    EXPECT_NEAR(vmf_entropy(kappa), entropy, 2e-3) << kappa;
  }
  EXPECT_NEAR(vmf_entropy(1e5), 1 - std::log(1e5 / (2 * std::numbers::pi)), 1e-6);
}

TEST(VmfMerge, CostBoundsTheDivergence) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    auto c = random_lobes(2, seed, 60);
    const float total = c[0].weight + c[1].weight;
    for (VmfComponent& lobe : c) lobe.weight /= total;
    const VmfComponent m = merge(c[0], c[1]);
    const double divergence = test::integrate_sphere(
        [&](const Vec3& w) {
          const double p = test::density(c, w);
          return p > 1e-30 ? p * std::log(p / test::density(m, w)) : 0.0;
        },
        200);
    EXPECT_GE(merge_cost(c[0], c[1]), divergence - 1e-4) << seed;
    EXPECT_GT(divergence, 0);
  }
}

TEST(VmfReduction, CostsAreMonotoneAndEndAtTheCollapse) {
  for (int count : {8, 20, 64}) {
    const auto components = random_lobes(count, count);
    double previous = 0;
    for (int left = count; left >= 1; left -= 1 + count / 16) {
      const VmfReductionResult result = reduce_vmf_mixture(components, 0, left);
      ASSERT_EQ(result.components.size(), size_t(left));
      EXPECT_GE(result.cost, previous);
      EXPECT_LE(result.cost, result.collapse_cost * (1 + 1e-5));
      previous = result.cost;
    }
    const VmfReductionResult one = reduce_vmf_mixture(components, 100, 8);
    EXPECT_EQ(one.components.size(), 1u);
    EXPECT_NEAR(one.percent(), 100, 1e-3);
  }
}

TEST(VmfReduction, StopsBelowTheThreshold) {
  const auto components = random_lobes(8, 3);
  size_t previous = 8;
  for (float max_cost : {0.0f, 5.0f, 10.0f, 30.0f, 70.0f}) {
    const VmfReductionResult result = reduce_vmf_mixture(components, max_cost, 8);
    EXPECT_LE(result.percent(), max_cost + 1e-4);
    EXPECT_LE(result.components.size(), previous);
    previous = result.components.size();
  }
  EXPECT_LT(previous, 8u);
}

TEST(VmfReduction, KeepsTheResultantOfTheWhole) {
  const auto half = reduce_vmf_mixture(random_lobes(8, 5), 0, 4).components;
  const auto all = reduce_vmf_mixture(random_lobes(8, 5), 0, 8).components;
  ASSERT_EQ(half.size(), 4u);
  EXPECT_LT((resultant(half) - resultant(all)).norm(), 1e-5);
}

TEST(VmfReduction, MergesEqualLobesAtNoCost) {
  for (float kappa : {0.0f, 7.0f, kMaxKappa}) {
    const std::vector<VmfComponent> equal(8, {0.5f, Vec3(1, 1, 1).normalized(), kappa});
    const VmfReductionResult result = reduce_vmf_mixture(equal, 0, 8);
    ASSERT_EQ(result.components.size(), 1u) << kappa;
    EXPECT_NEAR(result.cost, 0, 1e-6);
    EXPECT_NEAR(result.components[0].kappa, kappa, 1e-5f * kappa);
  }
}

TEST(VmfReduction, LeavesOutWhatIsNoLobe) {
  std::vector<VmfComponent> components = random_lobes(3, 1);
  components[1].kappa = std::nanf("");
  components.push_back({0, Vec3::UnitX(), 1});
  EXPECT_EQ(reduce_vmf_mixture(components, 0, 8).components.size(), 2u);
  EXPECT_TRUE(reduce_vmf_mixture({}, 10, 8).components.empty());
}

}  // namespace
}  // namespace waylight
