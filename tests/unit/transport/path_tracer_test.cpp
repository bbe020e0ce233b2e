#include "libguide/transport/path_tracer.h"

#include <gtest/gtest.h>

#include "common/small_media.h"

namespace waylight {
namespace {

// One cell, in which light comes alike from everywhere.
GuideCache evenly_lit() {
  GuideCache cache;
  cache.medium.nodes = {{0, 0, kLeafAxis}};
  cache.medium.components = {{1, Vec3::UnitX(), 0}};
  MediumCell cell;
  cell.indirect = {1, 1000, 1000, 0, 1};
  cache.medium.cells = {cell};
  return cache;
}

// A medium that absorbs nothing, within walls of smooth glass.
SceneDescription glass_box() {
  SceneDescription scene = testing::box_of(testing::homogeneous(Color::Constant(4), Color::Ones()),
                                           Vec3(-1, -1, -1), Vec3(1, 1, 1));
  DielectricMaterial glass;
  glass.eta = 2;
  scene.materials[0].model = glass;
  return scene;
}

TEST(GuidedRoulette, SparesPathsBetweenGlassWallsThatAreWorthAsMuchAsWhenTheyEntered) {
  const Scene scene(glass_box());
  const GuideCache cache = evenly_lit();
  const GuidingCaches caches(nullptr, GuideCacheView(cache), scene.description().materials,
                             scene.description().media);
  PathTracerOptions options;
  options.roulette = Roulette::guided;
  options.rr_depth = 2;  // the caches have not seen paths that enter
  options.max_depth = 90;
  const PathTracer tracer(scene, caches, options);
  uint32_t killed = 0, edges = 0;
  constexpr int kPaths = 2000;
  for (int i = 0; i < kPaths; ++i) {
    const PathRecord path = tracer.trace({Vec3(0.2f, 0.1f, -4), Vec3::UnitZ()}, Sampler(1, 2, i));
    killed += path.killed;
    edges += path.edges;
  }
  EXPECT_EQ(killed, 0u);
  EXPECT_GT(edges, 20u * kPaths);  // the walls reflect most of what meets them from within
}

}  // namespace
}  // namespace waylight
