// Photons lie where guiding looks for them.

#include "libguide/transport/photon_tracer.h"

#include <gtest/gtest.h>

#include "common/small_scenes.h"

namespace waylight {
namespace {

// A ball of ground glass under a lamp: light enters, crosses it, and leaves.
SceneDescription glass_ball() {
  SceneDescription scene;
  RoughDielectricMaterial glass;
  glass.alpha_u = glass.alpha_v = Texture(0.2f);
  const int ground = testing::add_material(scene, "ground", glass);
  const int black = testing::add_material(scene, "black", DiffuseMaterial{Texture(0.0f)});
  testing::add_shape(scene, Sphere{{0, 0, 0}, 1.0f, Mat3::Identity()}, ground);
  const uint32_t lamp = testing::add_shape(
      scene, testing::rectangle({-1, -1, 3}, {0, 2, 0}, {2, 0, 0}), black);
  testing::make_light(scene, lamp, Color(1, 1, 1));
  testing::look_along_z(scene, {0, 0, -5}, 4, 4);
  return scene;
}

TEST(PhotonTracer, RoughGlassStoresPhotonsOnBothSidesWithNormalsTowardsThem) {
  const Scene scene(glass_ball());
  PhotonTracerOptions options;
  options.max_depth = 16;
  options.rr_depth = 8;
  options.power_scale = 1.0f / 2000;
  const PhotonTracer tracer(scene, options);
  PhotonRecords records;
  for (uint32_t i = 0; i < 2000; ++i) {
    Sampler sampler(1, 1, i);
    tracer.trace(sampler, &records);
  }
  int outside = 0, inside = 0;
  for (const Photon& photon : records.photons) {
    if (photon.position.norm() > 1.1f) continue;
    EXPECT_GT(photon.normal.dot(photon.direction), 0);
    ++(photon.normal.dot(photon.position) > 0 ? outside : inside);
  }
  EXPECT_GT(outside, 100);
  EXPECT_GT(inside, outside / 2);
}

}  // namespace
}  // namespace waylight
