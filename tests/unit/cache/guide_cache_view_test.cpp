#include "libguide/cache/guide_cache_view.h"

#include <gtest/gtest.h>

#include <functional>

namespace waylight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Two cells left and right of x = 0, facing up; the right one knows nothing.
GuideCache two_cells() {
  GuideCache cache;
  cache.scene_bounds = {Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  cache.nodes = {{0, 1, 0}, {0, 0, kLeafAxis}, {0, 1, kLeafAxis}};
  cache.cells.resize(2);
  cache.cells[0].effective_samples = 100;
  cache.cells[0].component_count = 2;
  cache.cells[0].guided_mass = 1;
  cache.cells[1].first_component = 2;
  cache.components = {{0.25f, 0.1f, 0.2f, 0.01f, 0, 0.02f}, {0.75f, -0.3f, 0, 0.04f, 0.01f, 0.01f}};
  return cache;
}

TEST(GuideCacheView, AnswersWhereItKnowsSomething) {
  const GuideCache cache = two_cells();
  const GuideCacheView view(cache);
  const CacheCell* cell = view.query(Vec3(-0.5f, 0, 0), Vec3::UnitZ());
  ASSERT_EQ(cell, cache.cells.data());
  EXPECT_EQ(view.mixture(*cell).count(), 2);
  EXPECT_EQ(view.query(Vec3(0.5f, 0, 0), Vec3::UnitZ()), nullptr);
}

TEST(GuideCacheView, IsSilentOnTooLittleEvidence) {
  GuideCache cache = two_cells();
  cache.cells[0].effective_samples = 0.9f * kMinEffectiveSamples;
  EXPECT_EQ(GuideCacheView(cache).query(Vec3(-0.5f, 0, 0), Vec3::UnitZ()), nullptr);
}

TEST(GuideCacheView, TrustsACellAsFarAsItsEvidenceGoes) {
  CacheCell cell;
  EXPECT_EQ(guiding_trust(cell), 0);
  cell.effective_samples = kHalfTrustSamples;
  EXPECT_EQ(guiding_trust(cell), 0.5f);
  float previous = 0;
  for (cell.effective_samples = 1e-3f; cell.effective_samples < 1e7f; cell.effective_samples *= 2) {
    EXPECT_GT(guiding_trust(cell), previous);
    previous = guiding_trust(cell);
  }
  EXPECT_LE(previous, 1);
}

TEST(GuideCacheView, DoesNotGuideTheOtherSideOfAWall) {
  const GuideCache cache = two_cells();
  EXPECT_EQ(GuideCacheView(cache).query(Vec3(-0.5f, 0, 0), -Vec3::UnitZ()), nullptr);
  EXPECT_EQ(GuideCacheView(cache).query(Vec3(-0.5f, 0, 0), Vec3::Constant(kNan)), nullptr);
}

TEST(GuideCacheView, EmptyCacheIsValidAndKnowsNothing) {
  const GuideCache empty;
  EXPECT_EQ(check(GuideCacheView(empty)), "");
  EXPECT_EQ(GuideCacheView(empty).query(Vec3::Zero(), Vec3::UnitZ()), nullptr);
}

TEST(GuideCacheViewCheck, AcceptsAValidCache) {
  const GuideCache cache = two_cells();
  EXPECT_EQ(check(GuideCacheView(cache)), "");
}

TEST(GuideCacheViewCheck, RefusesEveryKindOfDamage) {
  const std::vector<std::function<void(GuideCache&)>> damages = {
      [](GuideCache& c) { c.scene_bounds = {}; },
      [](GuideCache& c) { c.scene_bounds.max.x() = kInfinity; },
      [](GuideCache& c) { c.nodes.pop_back(); },
      [](GuideCache& c) { c.nodes[0].child = 0; },
      [](GuideCache& c) { c.cells[0].normal = Vec3::Zero(); },
      [](GuideCache& c) { c.cells[0].normal.x() = kNan; },
      [](GuideCache& c) { c.cells[0].irradiance = kInfinity; },
      [](GuideCache& c) { c.cells[1].photon_count = -1; },
      [](GuideCache& c) { c.cells[0].effective_samples = kNan; },
      [](GuideCache& c) { c.cells[0].guided_mass = 2; },
      [](GuideCache& c) { c.cells[0].component_count = 3; },
      [](GuideCache& c) { c.cells[0].component_count = 9; },
      [](GuideCache& c) { c.cells[0].component_count = 0xffffffff; },
      [](GuideCache& c) { c.cells[1].first_component = 0xffffffff; },
      [](GuideCache& c) { c.components[0].weight = 0; },
      [](GuideCache& c) { c.components[0].weight = 0.5f; },
      [](GuideCache& c) { c.components[1].mean_x = kNan; },
      [](GuideCache& c) { c.components[1].cov_xx = -0.04f; },
      [](GuideCache& c) { c.components[1].cov_xy = 0.5f; },
      [](GuideCache& c) { c.components[0].cov_yy = kInfinity; },
  };
  for (size_t i = 0; i < damages.size(); ++i) {
    GuideCache cache = two_cells();
    damages[i](cache);
    EXPECT_NE(check(GuideCacheView(cache)), "") << "damage " << i;
  }
}

}  // namespace
}  // namespace waylight
