#include "libguide/transport/path_tracer.h"

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "common/trained.h"

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

TEST(PathTracer, RecordsTheFirstVertexOfPathsThatEndThere) {
  SceneDescription description;
  testing::add_shape(description, testing::rectangle({-9, -9, 3}, {0, 18, 0}, {18, 0, 0}),
                     testing::add_two_sided(description, "grey", DiffuseMaterial{Texture(0.25f)}));
  testing::look_along_z(description, {0, 0, 0}, 8, 8);
  const Scene scene(std::move(description));
  const GuidingCaches caches(nullptr, {}, scene.description().materials);
  PathTracerOptions options;
  options.max_depth = 1;
  const PathTracer tracer(scene, caches, options);
  const PathRecord path = tracer.trace({Vec3(1, 0, 0), Vec3::UnitZ()}, Sampler(1, 2, 3));
  EXPECT_NEAR(path.depth, 3, 1e-5f);
  EXPECT_NEAR(std::abs(path.normal.z()), 1, 1e-5f);
  EXPECT_EQ(path.albedo.x(), 0.25f);
  EXPECT_EQ(path.scatterings, 0u);
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

// The mean of the chances of being killed is 1 - 0.95^n where nothing is lost: of a path that
// crosses a block of glass, n = 2, it is a tenth.
TEST(ThroughputRoulette, SparesPathsThatHavePassedThroughGlass) {
  SceneDescription description;
  DielectricMaterial glass;
  glass.eta = 1.5f;
  const int material = testing::add_material(description, "glass", glass);
  for (const float z : {0.0f, 2.0f, 4.0f})
    testing::add_shape(description, testing::box({-9, -9, z}, {9, 9, z + 1}), material);
  testing::look_along_z(description, {0, 0, -4}, 8, 8);
  const Scene scene(std::move(description));
  const GuidingCaches caches(nullptr, {}, scene.description().materials);
  PathTracerOptions options;
  options.roulette = Roulette::throughput;
  options.rr_depth = 1;
  const PathTracer tracer(scene, caches, options);
  uint32_t killed = 0;
  constexpr int kPaths = 4000;
  for (int i = 0; i < kPaths; ++i)
    killed += tracer.trace({Vec3(0.2f, 0.1f, -4), Vec3::UnitZ()}, Sampler(1, 2, i)).killed;
  EXPECT_LT(killed, kPaths * 0.45);  // of six to eight scatterings
}

TEST(GuidedRoulette, JudgesPathsOnSurfacesThatAreLeftToTheirBsdf) {
  const Scene scene(testing::gap_box(8, 8));
  const testing::Trained trained = testing::train(scene, 50'000);
  const GuidingCaches caches(nullptr, GuideCacheView(trained.guide), scene.description().materials);
  PathTracerOptions options;
  options.roulette = Roulette::guided;
  options.max_split = 8;
  const PathTracer tracer(scene, caches, options);
  uint32_t killed = 0, copies = 0, guided = 0;
  for (int i = 0; i < 2000; ++i) {
    PathContext context;
    context.pixel_estimate = i % 2 ? 1e-3f : 1e3f;
    const PathRecord path = tracer.trace({Vec3(0, 0, -0.95f), Vec3(0.3f, 0.2f, 1).normalized()},
                                         Sampler(1, 2, i), context);
    (i % 2 ? copies : killed) += i % 2 ? path.copies : path.killed;
    guided += path.guided;
  }
  EXPECT_GT(killed, 800u);
  EXPECT_GT(copies, 2000u);
  EXPECT_EQ(guided, 0u);
}

TEST(PathTracer, DepthAndNormalAreOfWhatIsSeenThroughAPane) {
  SceneDescription description;
  ThinDielectricMaterial pane;
  testing::add_shape(description, testing::rectangle({-9, -9, 1}, {18, 0, 0}, {0, 18, 0}),
                     testing::add_material(description, "pane", pane));
  testing::add_shape(description, testing::rectangle({-9, -9, 3}, {0, 18, 0}, {9, 0, 0}),
                     testing::add_two_sided(description, "wall", DiffuseMaterial{Texture(0.5f)}));
  testing::look_along_z(description, {0, 0, 0}, 8, 8);
  const Scene scene(std::move(description));
  const GuidingCaches caches(nullptr, {}, scene.description().materials);
  const PathTracer tracer(scene, caches, {});
  int reflected = 0;
  for (int i = 0; i < 500; ++i) {
    const auto first = [&](float x) {
      return tracer.trace({Vec3(x, 0, 0), Vec3::UnitZ()}, Sampler(1, 2, i));
    };
    const PathRecord wall = first(-1), beside = first(1);  // nothing but the pane
    reflected += wall.depth < 2;
    EXPECT_NEAR(wall.depth, wall.depth < 2 ? 1 : 3, 1e-4);
    EXPECT_TRUE(beside.depth == 0 || std::abs(beside.depth - 1) < 1e-4);
  }
  EXPECT_GT(reflected, 10);
  EXPECT_LT(reflected, 100);
}

}  // namespace
}  // namespace waylight
