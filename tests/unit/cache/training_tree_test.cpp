#include "libguide/cache/training_tree.h"

#include <gtest/gtest.h>

#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/mixture_growth.h"
#include "libguide/cache/training_check.h"

namespace waylight {
namespace {

// Cells in a row along x, at x = 0.5, 1.5, ...; the tree is a list.
GuideCache row_of_cells(std::span<const Vec3> normals) {
  GuideCache cache;
  cache.scene_bounds = {Vec3(-10, -1, -1), Vec3(10, 1, 1)};
  cache.emitted = cache.photons = 1000;
  cache.nodes = {{0, 0, kLeafAxis}};
  for (uint32_t i = 0; i < normals.size(); ++i) {
    if (i > 0) {
      const uint32_t child = static_cast<uint32_t>(cache.nodes.size());
      cache.nodes.back() = {static_cast<float>(i), child, 0};
      cache.nodes.push_back({0, i - 1, kLeafAxis});
      cache.nodes.push_back({0, i, kLeafAxis});
    }
    cache.cells.emplace_back().normal = normals[i];
    CellTraining& t = cache.training.emplace_back();
    t.count = 10, t.flux = 10;
    t.position_mean = Vec3(i + 0.5f, 0, 0);
    t.normal_mean = normals[i];
  }
  return cache;
}

// Must be called for cells in increasing order.
void give_mixture(GuideCache& cache, uint32_t cell, float mean) {
  cache.cells[cell].first_component = static_cast<uint32_t>(cache.components.size());
  cache.cells[cell].component_count = 1;
  cache.cells[cell].photon_count = cache.cells[cell].effective_samples = 100;
  cache.components.push_back({1, mean, 0, 0.01f, 0, 0.01f});
  cache.statistics.push_back(statistics_of(cache.components.back()));
  CellTraining& t = cache.training[cell];
  t.step = 4, t.samples = 100, t.weight_sum = t.weight_sum2 = 100;
}

GuideCache after_lending(const GuideCache& cache) {
  TrainingTree tree(cache);
  tree.lend_mixtures();
  GuideCache result = cache;
  tree.store(result, TreeOptions(), 1);
  EXPECT_EQ(check(GuideCacheView(result)), "");
  EXPECT_EQ(check_training(result), "");
  return result;
}

TEST(TrainingTree, PassesWithoutPhotonsChangeNothing) {
  const std::vector<Vec3> normals(2, Vec3::UnitZ());
  GuideCache cache = row_of_cells(normals);
  give_mixture(cache, 0, -0.5f);
  const GuideCache once = after_lending(cache), twice = after_lending(once);
  ASSERT_EQ(twice.components.size(), 2u);
  for (size_t i = 0; i < 2; ++i) EXPECT_EQ(twice.components[i].cov_xx, once.components[i].cov_xx);
}

TEST(TrainingTree, CellsWithoutMixtureInheritFromTheNearestRelative) {
  const std::vector<Vec3> normals(4, Vec3::UnitZ());
  GuideCache cache = row_of_cells(normals);
  give_mixture(cache, 0, -0.5f);
  give_mixture(cache, 3, 0.5f);
  const GuideCache lent = after_lending(cache);
  for (const CacheCell& cell : lent.cells) ASSERT_EQ(cell.component_count, 1u);
  EXPECT_EQ(lent.components[lent.cells[2].first_component].mean_x, 0.5f);
  EXPECT_EQ(lent.cells[2].effective_samples, 50);
  EXPECT_EQ(lent.components[lent.cells[1].first_component].mean_x, 0.5f);  // by the tree
  EXPECT_EQ(lent.cells[1].effective_samples, 50);
  EXPECT_EQ(lent.cells[0].effective_samples, 100);
}

// Wherever the origin is.
TEST(TrainingTree, CellsThatSawNothingLieWhereTheirParentsPhotonsDo) {
  GuideCache cache = row_of_cells(std::vector<Vec3>{Vec3::UnitZ()});
  TrainingTree tree(cache);
  const TrainingCell child = tree[0].child({0, 0.5f}, true, 1000, 1e-6, {});
  EXPECT_EQ(child.centre(), Vec3(0.5f, 0, 0));
}

TEST(TrainingTree, NothingIsInheritedFromSurfacesThatFaceAway) {
  const std::vector<Vec3> normals = {Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitX()};
  GuideCache cache = row_of_cells(normals);
  give_mixture(cache, 0, 0);
  const GuideCache lent = after_lending(cache);
  EXPECT_EQ(lent.cells[1].component_count, 0u);
  EXPECT_EQ(lent.cells[2].component_count, 0u);
}

TEST(TrainingTree, WhereNoCellKnowsAnythingNothingIsInherited) {
  const std::vector<Vec3> normals(3, Vec3::UnitZ());
  const GuideCache lent = after_lending(row_of_cells(normals));
  EXPECT_TRUE(lent.components.empty());
}

}  // namespace
}  // namespace waylight
