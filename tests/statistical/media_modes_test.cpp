// Every combination of guided decisions in media has the mean of plain path tracing.

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "common/trained.h"

namespace waylight {
namespace {

using testing::mean_z;
using testing::train;
using testing::Trained;

// The room with a gap, full of fog, and a ball of coloured fog in glass.
SceneDescription foggy_gap_box() {
  SceneDescription scene = testing::gap_box(12, 8);
  scene.media.push_back(testing::homogeneous(Color::Constant(0.4f), Color(0.9f, 0.9f, 0.8f), 0.5f));
  scene.media.push_back(testing::homogeneous(Color(1, 3, 6), Color(0.95f, 0.9f, 0.8f)));
  const int null = testing::add_material(scene, "null", NullMaterial{});
  const Vec3 inside(0.99f, 0.99f, 1.49f), middle(0, 0, 0.5f);
  const uint32_t fog =
      testing::add_shape(scene, testing::box(middle - inside, middle + inside), null);
  scene.shapes[fog].interior_medium = 0;
  const uint32_t ball =
      testing::add_shape(scene, Sphere{{0.4f, -0.5f, -0.2f}, 0.3f},
                         testing::add_material(scene, "glass", DielectricMaterial{}));
  scene.shapes[ball].interior_medium = 1;
  scene.shapes[ball].exterior_medium = 0;
  scene.integrator.max_depth = 12;
  return scene;
}

// A cloud under a lamp and a sky.
SceneDescription small_cloud() {
  SceneDescription scene = testing::box_of(testing::cloud(testing::lumpy_grid(), 12, 0.95f),
                                           {0, 0, 0}, {1, 1, 1}, 12, 8);
  scene.emitters.push_back(ConstantEnvironment{Color(0.2f, 0.3f, 0.4f)});
  const uint32_t lamp =
      testing::add_shape(scene, Sphere{{1.2f, 1.5f, 0.5f}, 0.1f},
                         testing::add_material(scene, "black", DiffuseMaterial{Texture(0.0f)}));
  testing::make_light(scene, lamp, Color(200, 180, 150));
  testing::look_along_z(scene, {0.5f, 0.5f, -1.2f}, 12, 8);
  scene.integrator.max_depth = 30;
  return scene;
}

// A lamp in a globe of glass in thin fog, and a floor.
SceneDescription lantern() {
  SceneDescription scene;
  scene.media.push_back(testing::homogeneous(Color::Constant(0.15f), Color::Constant(0.95f), 0.4f));
  const int null = testing::add_material(scene, "null", NullMaterial{});
  const int black = testing::add_material(scene, "black", DiffuseMaterial{Texture(0.0f)});
  const int grey = testing::add_material(scene, "grey", DiffuseMaterial{Texture(0.5f)});
  const uint32_t fog = testing::add_shape(scene, testing::box({-2, -1, -2}, {2, 2, 2}), null);
  scene.shapes[fog].interior_medium = 0;
  testing::add_shape(scene, testing::box({-3, -2, -3}, {3, -1.01f, 3}), grey);
  const Vec3 place(0.5f, 0.8f, 0);
  const uint32_t globe = testing::add_shape(
      scene, Sphere{place, 0.4f}, testing::add_material(scene, "glass", DielectricMaterial{}));
  scene.shapes[globe].exterior_medium = 0;
  testing::make_light(scene, testing::add_shape(scene, Sphere{place, 0.15f}, black),
                      Color(60, 50, 30));
  testing::look_along_z(scene, {0, 0.3f, -4}, 12, 8);
  scene.integrator.max_depth = 10;
  return scene;
}

RenderOptions options_of(DistanceMode distance, PhaseMode direction, RouletteMode roulette,
                         int split) {
  RenderOptions options;
  options.distance = distance;
  options.direction = direction;
  options.roulette = roulette;
  options.split = split;
  options.spp = 400;
  options.seed = 9;
  options.aovs.variance = true;
  return options;
}

void expect_equal_means(SceneDescription description, const char* name, bool places = false) {
  const Scene scene(std::move(description));
  const Trained trained = train(scene, 100'000, false, places);
  EXPECT_EQ(trained.guide.medium.focused_cells.empty(), !places);
  RenderOptions plain =
      options_of(DistanceMode::standard, PhaseMode::standard, RouletteMode::throughput, 1);
  plain.spp = 4000;
  plain.seed = 2;
  const Image reference = render(scene, {}, plain, nullptr, {});
  for (const DistanceMode distance : {DistanceMode::standard, DistanceMode::guided})
    for (const PhaseMode direction : {PhaseMode::standard, PhaseMode::mixture, PhaseMode::product})
      for (const auto& [roulette, split] :
           {std::pair(RouletteMode::throughput, 1), std::pair(RouletteMode::guided, 1),
            std::pair(RouletteMode::guided, 8)}) {
        RenderSummary summary;
        const Image image = render(scene, trained.caches(),
                                   options_of(distance, direction, roulette, split), &summary, {});
        EXPECT_EQ(summary.invalid_samples, 0u);
        EXPECT_LT(std::abs(mean_z(image, reference)), 4)
            << name << ", distance " << int(distance) << ", direction " << int(direction)
            << ", roulette " << int(roulette) << ", split " << split;
      }
}

TEST(SlowMediaModes, AllHaveTheMeanOfPathTracingInAFoggyRoom) {
  expect_equal_means(foggy_gap_box(), "foggy room");
}

TEST(SlowMediaModes, AllHaveTheMeanOfPathTracingInACloud) {
  expect_equal_means(small_cloud(), "cloud");
}

TEST(SlowMediaModes, AllHaveTheMeanOfPathTracingWhereCellsPointToALamp) {
  expect_equal_means(lantern(), "lantern", true);
}

TEST(SlowMediaModes, ProductSplittingAndSurfacesTogetherAreUnbiased) {
  const Scene scene(foggy_gap_box());
  const Trained trained = train(scene, 100'000);
  RenderOptions plain =
      options_of(DistanceMode::standard, PhaseMode::standard, RouletteMode::throughput, 1);
  plain.spp = 4000;
  const Image reference = render(scene, {}, plain, nullptr, {});
  RenderOptions all =
      options_of(DistanceMode::automatic, PhaseMode::automatic, RouletteMode::automatic, 8);
  for (const RenderMode mode : {RenderMode::illumination, RenderMode::product}) {
    all.mode = mode;
    EXPECT_LT(std::abs(mean_z(render(scene, trained.caches(), all, nullptr, {}), reference)), 3.5);
  }
}

// The room with a gap, and thin smoke in a corner of it.
SceneDescription smoky_gap_box() {
  SceneDescription scene = testing::gap_box(12, 8);
  scene.media.push_back(testing::cloud(testing::lumpy_grid(), 0.3f));
  const uint32_t smoke = testing::add_shape(scene, testing::box({0, -0.9f, 0}, {0.9f, 0, 0.9f}),
                                            testing::add_material(scene, "null", NullMaterial{}));
  scene.shapes[smoke].interior_medium = 0;
  scene.integrator.max_depth = 12;
  return scene;
}

// The first change that mode auto tried, after everything guided and nothing.
std::string first_change_of_auto(SceneDescription description) {
  const Scene scene(std::move(description));
  const Trained trained = train(scene, 100'000);
  RenderOptions options;
  options.mode = RenderMode::automatic;
  options.spp = 3000;
  RenderSummary summary;
  render(scene, trained.caches(), options, &summary, {});
  return summary.decision.compared.size() > 2 ? summary.decision.compared[2].name : "";
}

TEST(SlowMediaModes, ModeAutoBeginsWithRouletteByThroughputWhereScatteringsAreInGrids) {
  EXPECT_EQ(first_change_of_auto(small_cloud()), "guided roulette");
}

TEST(SlowMediaModes, ModeAutoBeginsWithGuidedRouletteWhereScatteringsAreOnSurfaces) {
  EXPECT_EQ(first_change_of_auto(smoky_gap_box()), "roulette by throughput");
}

}  // namespace
}  // namespace waylight
