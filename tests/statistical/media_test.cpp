// Path tracing through media against closed forms.

#include <gtest/gtest.h>

#include "common/image_mean.h"
#include "common/small_media.h"
#include "libguide/render.h"

namespace waylight {
namespace {

using testing::box_of;
using testing::homogeneous;
using testing::Mean;

Mean mean_of(SceneDescription description, int spp, int max_depth = -1) {
  const Scene scene(std::move(description));
  RenderOptions options;
  options.spp = spp;
  options.max_depth = max_depth;
  options.aovs.variance = true;
  return testing::mean_of(render(scene, {}, options, nullptr, {}));
}

void expect_mean(const Mean& mean, const Color& expected, const char* what) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(mean.value[c], expected[c], 4 * mean.sigma[c] + 2e-4f * expected[c])
        << what << " channel " << c;
}

void narrow_view(SceneDescription& scene) { scene.sensor.fov = 0.01f; }

TEST(Media, AnAbsorbingSlabFollowsBeerLambert) {
  const Color sigma(0.2f, 1, 3);
  SceneDescription scene = box_of(homogeneous(sigma, Color::Zero()), {-5, -5, -1}, {5, 5, 1});
  narrow_view(scene);
  scene.emitters.push_back(ConstantEnvironment{Color(1, 2, 3)});
  expect_mean(mean_of(scene, 256), Color(1, 2, 3) * (-2 * sigma).exp(), "slab");
}

// Whatever a medium of albedo one does, radiance that comes evenly from all sides stays what it is.
TEST(Media, AMediumOfAlbedoOneVanishesInAWhiteFurnace) {
  for (const float g : {-0.7f, 0.0f, 0.85f})
    for (const Color& sigma : {Color(0.5f, 0.5f, 0.5f), Color(0.2f, 1, 4)}) {
      SceneDescription scene =
          box_of(homogeneous(sigma, Color::Ones(), g), {-1, -1, -1}, {1, 1, 1});
      scene.emitters.push_back(ConstantEnvironment{Color::Ones()});
      expect_mean(mean_of(scene, 256), Color::Ones(), "furnace");
    }
}

TEST(Media, ACloudOfAlbedoOneVanishesInAWhiteFurnace) {
  for (const int channels : {1, 3}) {
    SceneDescription scene =
        box_of(testing::cloud(testing::lumpy_grid(channels), 8, 1), {0, 0, 0}, {1, 1, 1});
    scene.emitters.push_back(ConstantEnvironment{Color::Ones()});
    testing::look_along_z(scene, {0.5f, 0.5f, -1.5f}, 8, 8);
    expect_mean(mean_of(scene, 256), Color::Ones(), "furnace");
  }
}

TEST(Media, AGlassBallOfFogVanishesInAWhiteFurnace) {
  SceneDescription scene;
  scene.media.push_back(homogeneous(Color(0.5f, 1, 2), Color::Ones(), 0.3f));
  const uint32_t ball = testing::add_shape(
      scene, Sphere{}, testing::add_material(scene, "glass", DielectricMaterial{}));
  scene.shapes[ball].interior_medium = 0;
  scene.emitters.push_back(ConstantEnvironment{Color::Ones()});
  testing::look_along_z(scene, {0, 0, -4}, 8, 8);
  expect_mean(mean_of(scene, 512), Color::Ones(), "glass ball");
}

// Light E along -z... through a slab of depth d, seen against the light at normal incidence: with
// isotropic scattering once, L = E albedo / (4 pi) (1 - e^(-2 sigma d)) / 2.
TEST(Media, SingleScatteringInASlabHasItsClosedForm) {
  const Color sigma(0.3f, 1, 2), albedo(0.9f, 0.5f, 0.7f);
  SceneDescription scene = box_of(homogeneous(sigma, albedo), {-50, -50, -1}, {50, 50, 1});
  narrow_view(scene);
  scene.emitters.push_back(DirectionalLight{Vec3::UnitZ(), Color(3, 3, 3)});
  const Color expected = 3 * albedo * (0.25f * kInvPi) * 0.5f * (1 - (-4 * sigma).exp());
  expect_mean(mean_of(scene, 4096, 2), expected, "single scattering");
}

// A pane in front of a lamp: what next-event estimation sees through it and what paths find beyond
// add up to the lamp times the pane's transmission.
TEST(Media, APaneIsSeenThroughByShadowRays) {
  SceneDescription scene;
  const int white = testing::add_two_sided(scene, "white", DiffuseMaterial{Texture(0.5f)});
  testing::add_shape(scene, testing::rectangle({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), white);
  const uint32_t lamp =
      testing::add_shape(scene, testing::rectangle({-1, -1, -3}, {2, 0, 0}, {0, 2, 0}), white);
  testing::make_light(scene, lamp, Color(5, 5, 5));
  testing::look_along_z(scene, {0, 0, 0}, 4, 4);
  const Mean open = mean_of(scene, 256, 2);
  testing::add_shape(scene, testing::rectangle({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}),
                     testing::add_material(scene, "pane", ThinDielectricMaterial{}));
  const Mean behind_pane = mean_of(scene, 256, 2);
  EXPECT_GT(behind_pane.value.x(), 0.85f * open.value.x());
  EXPECT_LT(behind_pane.value.x(), 0.95f * open.value.x());
}

TEST(Media, TheCameraFindsTheMediumAroundIt) {
  const Color sigma = Color::Constant(0.7f);
  SceneDescription scene = box_of(homogeneous(sigma, Color::Zero()), {-5, -5, -5}, {5, 5, 1});
  narrow_view(scene);
  scene.emitters.push_back(ConstantEnvironment{Color::Ones()});
  expect_mean(mean_of(scene, 256), (-5 * sigma).exp(), "camera inside");
}

}  // namespace
}  // namespace waylight
