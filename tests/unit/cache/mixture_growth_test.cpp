#include "libguide/cache/mixture_growth.h"

#include <gtest/gtest.h>

#include <array>

#include "libguide/math/types.h"

namespace waylight {
namespace {

using Components = std::array<GaussianComponent, 8>;
using Statistics = std::array<ComponentStatistics, 8>;

struct Moments {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

Moments about_origin(std::span<const GaussianComponent> components) {
  Moments m;
  for (const GaussianComponent& c : components) {
    m.weight += c.weight;
    m.x += c.weight * c.mean_x;
    m.y += c.weight * c.mean_y;
    m.xx += c.weight * (c.cov_xx + c.mean_x * c.mean_x);
    m.xy += c.weight * (c.cov_xy + c.mean_x * c.mean_y);
    m.yy += c.weight * (c.cov_yy + c.mean_y * c.mean_y);
  }
  return m;
}

TEST(MixtureGrowth, KeepsTheMomentsOfTheMixture) {
  Components components{
      {{0.7f, 0.2f, -0.1f, 0.09f, 0.05f, 0.04f}, {0.3f, -0.4f, 0.3f, 0.01f, 0, 0.02f}}};
  Statistics statistics{};
  const Moments before = about_origin(std::span(components).first(2));
  ASSERT_EQ(grow_mixture(components, statistics, 2, 8), 8u);
  const Moments after = about_origin(components);
  EXPECT_NEAR(after.weight, before.weight, 1e-6);
  EXPECT_NEAR(after.x, before.x, 1e-6);
  EXPECT_NEAR(after.y, before.y, 1e-6);
  EXPECT_NEAR(after.xx, before.xx, 1e-6);
  EXPECT_NEAR(after.xy, before.xy, 1e-6);
  EXPECT_NEAR(after.yy, before.yy, 1e-6);
}

TEST(MixtureGrowth, HalvesStandApartAndStayPositiveDefinite) {
  Components components{{{1, 0, 0, 0.5f, 0.4999f, 0.5f}}};  // nearly a line
  Statistics statistics{};
  ASSERT_EQ(grow_mixture(components, statistics, 1, 8), 8u);
  for (size_t i = 0; i < 8; ++i) {
    const GaussianComponent& c = components[i];
    EXPECT_GT(double{c.cov_xx} * c.cov_yy - double{c.cov_xy} * c.cov_xy, 0);
    EXPECT_FLOAT_EQ(statistics[i].s0, c.weight);
    EXPECT_FLOAT_EQ(statistics[i].s2_xy, c.weight * c.cov_xy);
    for (size_t j = 0; j < i; ++j)
      EXPECT_GT(std::hypot(c.mean_x - components[j].mean_x, c.mean_y - components[j].mean_y),
                0.01f);
  }
}

TEST(MixtureGrowth, LeavesAFullOrAnEmptyMixtureAlone) {
  Components components{};
  Statistics statistics{};
  EXPECT_EQ(grow_mixture(components, statistics, 0, 8), 0u);
  EXPECT_EQ(grow_mixture(components, statistics, 8, 4), 8u);
}

}  // namespace
}  // namespace waylight
