// Media that emit, against closed forms, in every mode.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/image_mean.h"
#include "common/small_media.h"
#include "common/trained.h"
#include "libguide/cache/guide_cache_view.h"

namespace waylight {
namespace {

using testing::box_of;
using testing::homogeneous;
using testing::Mean;
using testing::mean_of;

const Color kLe(3, 2, 1);

Medium glowing(Medium medium) {
  medium.emission.radiance = kLe;
  return medium;
}

void expect_mean(const Image& image, const Color& expected, const std::string& what) {
  const Mean mean = mean_of(image);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean.value[c], expected[c], 4 * mean.sigma[c] + 3e-4f * expected[c])
        << what << " channel " << c;
    EXPECT_LT(mean.sigma[c], 0.015f * expected.maxCoeff()) << what << ": says too little";
  }
}

RenderOptions with_variance(int spp) {
  RenderOptions options;
  options.spp = spp;
  options.aovs.variance = true;
  return options;
}

SceneDescription slab(const Color& sigma, const Color& albedo) {
  SceneDescription scene = box_of(glowing(homogeneous(sigma, albedo)), {-50, -50, -1}, {50, 50, 1});
  scene.sensor.fov = 0.01f;
  return scene;
}

// The medium within surroundings of its own radiance: L = Le everywhere, whatever the albedo.
SceneDescription in_equilibrium(Medium medium) {
  SceneDescription scene = box_of(glowing(std::move(medium)), {0, 0, 0}, {1, 1, 1}, 12, 8);
  scene.emitters.push_back(ConstantEnvironment{kLe});
  testing::look_along_z(scene, {0.5f, 0.5f, -1}, 12, 8);
  return scene;
}

TEST(MediumEmission, AnAbsorbingSlabShowsLeTimesItsOpacity) {
  const Color sigma(0.2f, 1, 3);
  const Scene scene(slab(sigma, Color::Zero()));
  const Image image = render(scene, {}, with_variance(4), nullptr, {});
  expect_mean(image, kLe * (1 - (-2 * sigma).exp()), "slab");
}

TEST(MediumEmission, ASlabThatScattersShowsItsOwnEmissionOnTheFirstEdge) {
  const Color sigma(0.2f, 1, 3), albedo(0.9f, 0.5f, 0.2f);
  const Scene scene(slab(sigma, albedo));
  RenderOptions options = with_variance(4);
  options.max_depth = 1;
  const Image image = render(scene, {}, options, nullptr, {});
  expect_mean(image, (1 - albedo) * kLe * (1 - (-2 * sigma).exp()), "first edge");
}

TEST(MediumEmission, IsHiddenFromTheCameraWithTheEmitters) {
  SceneDescription description = slab(Color::Ones(), Color::Constant(0.5f));
  description.integrator.hide_emitters = true;
  description.integrator.max_depth = 1;
  const Scene hidden(description);
  EXPECT_EQ(mean_of(render(hidden, {}, with_variance(4), nullptr, {})).value.maxCoeff(), 0);
  description.integrator.max_depth = 2;
  const Scene scattered(description);
  EXPECT_GT(mean_of(render(scattered, {}, with_variance(4), nullptr, {})).value.minCoeff(), 0);
}

TEST(MediumEmission, LightsSurfaces) {
  // A wall in thick glowing fog reflects albedo Le.
  SceneDescription description =
      box_of(glowing(homogeneous(Color::Constant(1e3f), Color::Zero())), {-9, -9, -9}, {9, 9, 9});
  const int grey = testing::add_two_sided(description, "grey", DiffuseMaterial{Texture(0.5f)});
  testing::add_shape(description, testing::rectangle({-5, -5, 0}, {0, 10, 0}, {10, 0, 0}), grey);
  testing::look_along_z(description, {0, 0, -1e-4f}, 8, 8);
  description.sensor.fov = 0.01f;
  const Color t = Color::Constant(std::exp(-0.1f));
  const Scene scene(description);
  expect_mean(render(scene, {}, with_variance(64), nullptr, {}), kLe * (1 - t) + 0.5f * kLe * t,
              "wall");
}

void expect_equilibrium(const Medium& medium, const std::string& name, int spp) {
  const Scene scene(in_equilibrium(medium));
  const testing::Trained trained = testing::train(scene, 50'000);
  RenderOptions options = with_variance(spp);
  for (const DistanceMode distance :
       {DistanceMode::standard, DistanceMode::guided, DistanceMode::probability,
        DistanceMode::equiangular, DistanceMode::exponential})
    for (const auto& [direction, roulette, split] :
         {std::tuple(PhaseMode::standard, RouletteMode::throughput, 1),
          std::tuple(PhaseMode::mixture, RouletteMode::guided, 1),
          std::tuple(PhaseMode::product, RouletteMode::none, 1),
          std::tuple(PhaseMode::product, RouletteMode::guided, 8)}) {
      options.distance = distance;
      options.direction = direction;
      options.roulette = roulette;
      options.split = split;
      expect_mean(render(scene, trained.caches(), options, nullptr, {}), kLe,
                  fmt::format("{}, distance {}, direction {}, roulette {}, split {}", name,
                              int(distance), int(direction), int(roulette), split));
    }
}

TEST(SlowMediumEmission, AMediumInEquilibriumVanishesInEveryMode) {
  expect_equilibrium(homogeneous(Color::Constant(2), Color::Constant(0.7f), 0.5f), "fog", 128);
  expect_equilibrium(homogeneous(Color(0.5f, 1, 4), Color(0.2f, 0.9f, 0.5f)), "coloured fog", 128);
  expect_equilibrium(homogeneous(Color::Constant(3), Color::Zero()), "black fog", 128);
  expect_equilibrium(testing::cloud(testing::lumpy_grid(), 8, 0.8f), "cloud", 128);
  expect_equilibrium(testing::cloud(testing::lumpy_grid(3), 8, 0.8f), "coloured cloud", 128);
}

// Fluence in equilibrium is 4 pi Le: that of the surroundings is direct light, that of the medium,
// which next-event estimation does not find, counts as indirect with what is scattered.
TEST(MediumEmission, PhotonsOfAMediumInEquilibriumHaveItsFluence) {
  const Scene scene(in_equilibrium(homogeneous(Color::Constant(2), Color::Constant(0.4f))));
  const testing::Trained trained = testing::train(scene, 200'000);
  const MediumCacheView media(trained.guide.medium);
  double direct = 0, all = 0;
  constexpr int kPlaces = 1000;
  for (int i = 0; i < kPlaces; ++i) {
    Sampler sampler(5, 6, i);
    const Vec2 u = sampler.next_2d();
    const MediumCell& cell = *media.query({u.x(), u.y(), sampler.next()});
    direct += cell.direct.fluence / kPlaces;
    all += (cell.direct.fluence + cell.indirect.fluence) / kPlaces;
  }
  EXPECT_NEAR(all, 4 * kPi * luminance(kLe), 0.02 * 4 * kPi * luminance(kLe));
  EXPECT_LT(direct, 0.6 * all);
  EXPECT_GT(direct, 0.1 * all);
}

TEST(MediumEmission, PhotonsStartInMediaWithoutAnyEmitter) {
  const Scene scene(
      box_of(glowing(testing::cloud(testing::lumpy_grid(), 8, 0.5f)), {0, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(scene.has_lights());
  const testing::Trained trained = testing::train(scene, 20'000);
  const MediumCacheView media(trained.guide.medium);
  const MediumCell& core = *media.query({0.3f, 0.5f, 0.5f});
  EXPECT_GT(core.indirect.fluence, 0);
  EXPECT_EQ(core.direct.fluence, 0);
}

}  // namespace
}  // namespace waylight
