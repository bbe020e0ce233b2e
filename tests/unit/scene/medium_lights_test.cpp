// Media as sources of particles.

#include "libguide/scene/medium_lights.h"

#include <gtest/gtest.h>

#include "common/small_media.h"

namespace waylight {
namespace {

using testing::box_of;
using testing::cloud;
using testing::homogeneous;
using testing::lumpy_grid;

Medium glowing(Medium medium, const VolumeTexture& radiance) {
  medium.emission.radiance = radiance;
  return medium;
}

// The mean power of samples is 4 pi times `integral`, of sigma_a Le over the volume; the mean of
// power times place, `moment`, too.
void expect_power(const Scene& scene, const Color& integral, const Vec3& center, float tolerance) {
  constexpr int kCount = 1 << 16;
  const MediumLights lights(scene);
  Color sum = Color::Zero();
  Vec3 moment = Vec3::Zero(), direction = Vec3::Zero();
  for (int i = 0; i < kCount; ++i) {
    Sampler sampler(1, 2, i);
    const auto s = lights.sample(sampler);
    if (!s) continue;
    EXPECT_EQ(scene.medium_at(s->ray.origin), s->medium);
    sum += s->power / kCount;
    moment += s->power.mean() / kCount * s->ray.origin;
    direction += s->ray.direction / kCount;
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sum[c], 4 * kPi * integral[c], tolerance * sum.mean()) << c;
  EXPECT_LT((moment / sum.mean() - center).norm(), tolerance);
  EXPECT_LT(direction.norm(), 0.02f);
}

TEST(MediumLights, OfABoxOfFogHaveItsPower) {
  const Color sigma(0.5f, 1, 2), albedo(0.5f, 0, 0.75f), radiance(3, 2, 1);
  const Scene scene(box_of(glowing(homogeneous(sigma, albedo), radiance), {0, 0, 0}, {1, 2, 3}));
  expect_power(scene, 6 * (1 - albedo) * sigma * radiance, {0.5f, 1, 1.5f}, 0.02f);
  EXPECT_NEAR(MediumLights(scene).power(), 4 * kPi * 6 * ((1 - albedo) * sigma * radiance).mean(),
              1e-3);
}

TEST(MediumLights, LeaveOutWhatOfTheirBoxIsNotInTheMedium) {
  SceneDescription ball;
  ball.media.push_back(glowing(homogeneous(Color::Ones(), Color::Zero()), Color(1, 2, 3)));
  const int null = testing::add_material(ball, "null", NullMaterial{});
  ball.shapes[testing::add_shape(ball, Sphere{{1, 0, 0}, 0.5f}, null)].interior_medium = 0;
  expect_power(Scene(ball), kPi / 6 * Color(1, 2, 3), {1, 0, 0}, 0.02f);
}

TEST(MediumLights, OfACloudFollowItsDensityAndItsEmission) {
  const Medium medium = glowing(cloud(lumpy_grid(), 3, 0.4f), lumpy_grid());
  const Scene scene(box_of(medium, {-0.1f, -0.1f, -0.1f}, {1.1f, 1.1f, 1.1f}));
  constexpr int kSide = 100;
  double integral = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Vec3 p = (Vec3(i % kSide, i / kSide % kSide, i / kSide / kSide).array() + 0.5f) / kSide;
    const MediumTracker& tracker = scene.medium(0);
    const double emitted = 0.6 * tracker.at(p).sigma_t[0] * tracker.emitted_at(p)[0];
    integral += emitted / (kSide * kSide * kSide);
    moment += emitted / (kSide * kSide * kSide) * p.cast<double>();
  }
  expect_power(scene, Color::Constant(integral), (moment / integral).cast<float>(), 0.02f);
}

TEST(MediumLights, OfDarkAndOfWhiteMediaAreNone) {
  Sampler sampler(1, 2, 3);
  const Scene dark(box_of(homogeneous(Color::Ones(), Color::Zero()), {0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(dark.has_lights());
  EXPECT_FALSE(MediumLights(dark).sample(sampler));
  const Scene white(box_of(glowing(homogeneous(Color::Ones(), Color::Ones()), Color(1, 1, 1)),
                           {0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(MediumLights(white).power(), 0);
  EXPECT_FALSE(MediumLights(white).sample(sampler));
}

}  // namespace
}  // namespace waylight
