// F10 of the failure catalogue at the level of the scene: emitters of very unequal power.

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "unit/scene/scene_fixtures.h"

namespace waylight {
namespace {

using namespace fixtures;

constexpr float kRatio = 1e6f;

// A weak lamp just above the floor and one a million times as strong, far away and small.
SceneDescription unequal_lamps() {
  SceneDescription scene = scene_of({shape(square(1, 0))});
  scene.emitters = {PointLight{{0, 0, 0.1f}, Color::Constant(1)},
                    PointLight{{0, 0, 1000}, Color::Constant(kRatio)}};
  return scene;
}

TEST(UnequalLights, EachIsChosenOftenEnoughForDirectLight) {
  const Scene scene(unequal_lamps());
  int weak = 0;
  constexpr int kCount = 1000;
  for (int i = 0; i < kCount; ++i)
    weak += scene.sample_light(Vec3::Zero(), (i + 0.5f) / kCount, {0.5f, 0.5f})->distance < 1;
  EXPECT_NEAR(weak, 250, 2);
}

TEST(UnequalLights, DirectLightHasTheRightMeanAndBoundedVariance) {
  const Scene scene(unequal_lamps());
  constexpr int kCount = 10000;
  double sum = 0, sum2 = 0;
  for (int i = 0; i < kCount; ++i) {
    Sampler sampler(5, 0, i);
    const float u = sampler.next();
    const auto light = scene.sample_light(Vec3::Zero(), u, sampler.next_2d());
    const double value = light->radiance.x() * light->wi.z() / light->pdf;
    sum += value;
    sum2 += value * value;
  }
  const double expected = 1 / 0.01 + kRatio / 1e6;
  EXPECT_NEAR(sum / kCount, expected, 0.02 * expected);
  EXPECT_LT(sum2 / kCount, 5 * expected * expected);
}

TEST(UnequalLights, EmissionFollowsPower) {
  const Scene scene(unequal_lamps());
  double power = 0;
  int weak = 0;
  constexpr int kCount = 10000;
  for (int i = 0; i < kCount; ++i) {
    const auto emission = scene.sample_emission((i + 0.5f) / kCount, {0.5f, 0.5f}, {0.5f, 0.5f});
    power += emission->power.x() / kCount;
    weak += emission->emitter == 0;
  }
  EXPECT_NEAR(power, 4 * kPi * (kRatio + 1), 4 * kPi * kRatio * 1e-4);
  EXPECT_LE(weak, 1);
}

TEST(UnequalLights, TinyAndHugeEmittersGiveFiniteSamples) {
  for (const float size : {1e-6f, 1e6f}) {
    SceneDescription description = scene_of({shape(square(1, 0))});
    description.shapes.push_back(shape(square(size, 3, false)));
    description.shapes.push_back(shape(Vec3(0, 0, 10 + size), size));
    make_light(description, 1, Texture(1.0f));
    make_light(description, 2, Texture(1.0f));
    const Scene scene(std::move(description));
    int sampled = 0;
    for (int i = 0; i < 1000; ++i) {
      Sampler sampler(6, 0, i);
      const float u = sampler.next();
      const auto light = scene.sample_light(Vec3::Zero(), u, sampler.next_2d());
      if (!light) continue;
      ++sampled;
      EXPECT_TRUE(std::isfinite(light->pdf) && light->pdf > 0 && light->wi.allFinite());
      EXPECT_TRUE(std::isfinite(light->distance) && is_finite(light->radiance));
    }
    EXPECT_GT(sampled, 100) << size;
  }
}

TEST(DamagedEnvironmentMap, BadPixelsAreCountedAndTakenAsBlack) {
  const std::shared_ptr<Bitmap> picture = bitmap(8, 4, Color::Ones());
  picture->pixels[3] = Color(-1, 2, 0);
  picture->pixels[9] = Color(std::numeric_limits<float>::quiet_NaN(), 0, kInfinity);
  SceneDescription description = scene_of({shape(square(1, 0))});
  description.emitters = {EnvironmentMap{picture}};
  const Scene scene(std::move(description));
  ASSERT_EQ(scene.build_warnings().size(), 1u);
  EXPECT_NE(scene.build_warnings()[0].find("2 of 32"), std::string::npos);
  for (int i = 0; i < 1000; ++i) {
    Sampler sampler(8, 0, i);
    const float u = sampler.next();
    const auto light = scene.sample_light(Vec3::Zero(), u, sampler.next_2d());
    ASSERT_TRUE(light);
    EXPECT_TRUE(is_finite(light->radiance) && light->radiance.minCoeff() >= 0);
  }
}

TEST(UnequalLights, PointOnTheLightItselfGivesNoNan) {
  SceneDescription description = scene_of({shape(Vec3::Zero(), 1)});
  make_light(description, 0, Texture(1.0f));
  description.emitters.push_back(PointLight{Vec3::UnitX(), Color::Ones()});
  const Scene scene(std::move(description));
  for (int i = 0; i < 100; ++i) {
    Sampler sampler(6, 1, i);
    const float u = sampler.next();
    const auto light = scene.sample_light(Vec3::UnitX(), u, sampler.next_2d());
    if (light) {
      EXPECT_TRUE(std::isfinite(light->pdf) && light->wi.allFinite());
    }
  }
}

}  // namespace
}  // namespace waylight
