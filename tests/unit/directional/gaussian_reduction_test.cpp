#include "libguide/directional/gaussian_reduction.h"

#include <gtest/gtest.h>

#include "unit/directional/mixtures.h"

namespace waylight {
namespace {

using test::component;
using test::random_components;

TEST(Merge, KeepsWeightMeanAndSecondMoments) {
  const auto c = random_components(2, 1);
  const GaussianComponent m = merge(c[0], c[1]);
  const double w = double(c[0].weight) + c[1].weight;
  EXPECT_NEAR(m.weight, w, 1e-6);
  const auto raw = [](const GaussianComponent& g) {
    return g.weight * (g.cov_xy + double(g.mean_x) * g.mean_y);
  };
  EXPECT_NEAR(raw(m), raw(c[0]) + raw(c[1]), 1e-6);
  EXPECT_NEAR(w * m.mean_x, c[0].weight * c[0].mean_x + c[1].weight * c[1].mean_x, 1e-6);
}

TEST(Reduction, CostsAreMonotoneAndEndAtTheCollapse) {
  for (int count : {8, 20, 64}) {
    const auto components = random_components(count, count);
    double previous = 0;
    for (int left = count; left >= 1; --left) {
      const ReductionResult result = reduce_mixture(components, 0, left);
      ASSERT_EQ(result.components.size(), size_t(left));
      EXPECT_GE(result.cost, previous);
      EXPECT_LE(result.cost, result.collapse_cost * (1 + 1e-5));
      previous = result.cost;
    }
    const ReductionResult one = reduce_mixture(components, 100, 8);
    EXPECT_EQ(one.components.size(), 1u);
    EXPECT_NEAR(one.percent(), 100, 1e-3);
  }
}

TEST(Reduction, StopsBelowTheThreshold) {
  const auto components = random_components(8, 3);
  size_t previous = 8;
  for (float max_cost : {0.0f, 5.0f, 10.0f, 30.0f, 70.0f}) {
    const ReductionResult result = reduce_mixture(components, max_cost, 8);
    EXPECT_LE(result.percent(), max_cost + 1e-4);
    EXPECT_LE(result.components.size(), previous);
    previous = result.components.size();
    if (result.components.size() > 1) {
      const ReductionResult next =
          reduce_mixture(components, max_cost, int(result.components.size()) - 1);
      EXPECT_GT(next.percent(), max_cost);
    }
  }
  EXPECT_LT(previous, 8u);
}

TEST(Reduction, KeepsMeanAndCovarianceOfTheWhole) {
  const auto components = random_components(8, 5);
  const GaussianComponent before = reduce_mixture(components, 100, 1).components[0];
  const auto half = reduce_mixture(components, 0, 4).components;
  const GaussianComponent after = reduce_mixture(half, 100, 1).components[0];
  EXPECT_NEAR(after.mean_x, before.mean_x, 1e-5);
  EXPECT_NEAR(after.cov_xx, before.cov_xx, 1e-5);
  EXPECT_NEAR(after.cov_xy, before.cov_xy, 1e-5);
}

TEST(Reduction, MergesEqualComponentsAtNoCost) {
  const std::vector<GaussianComponent> equal(8, component(0.5f, {0.3f, 0.4f}, 0.1f, 0.2f, 0.7f));
  const ReductionResult result = reduce_mixture(equal, 0, 8);
  ASSERT_EQ(result.components.size(), 1u);
  EXPECT_NEAR(result.cost, 0, 1e-6);
  EXPECT_NEAR(result.components[0].cov_xy, 0.014f, 1e-6);
}

TEST(Reduction, LeavesOutWhatIsNoGaussian) {
  std::vector<GaussianComponent> components = random_components(3, 1);
  components[1].cov_xx = std::nanf("");
  components.push_back({0, 0, 0, 1, 0, 1});
  EXPECT_EQ(reduce_mixture(components, 0, 8).components.size(), 2u);
  EXPECT_TRUE(reduce_mixture({}, 10, 8).components.empty());
}

}  // namespace
}  // namespace waylight
