// What a few paths tell of the noise of a scene.

#include "libguide/transport/glance.h"

#include <gtest/gtest.h>

#include "common/small_scenes.h"

namespace waylight {
namespace {

// A rectangle that shines and fills the view.
SceneDescription shining() {
  SceneDescription scene;
  const int black = testing::add_two_sided(scene, "black", DiffuseMaterial{Texture(0.0f)});
  testing::make_light(
      scene,
      testing::add_shape(scene, testing::rectangle({-9, -9, 1}, {0, 18, 0}, {18, 0, 0}), black),
      Color(1, 1, 1));
  testing::look_along_z(scene, {0, 0, -3}, 32, 32);
  return scene;
}

Noise noise_of(const SceneDescription& description, uint64_t paths) {
  const Scene scene(description);
  const GuidingCaches caches;
  const PathTracer tracer(scene, caches, PathTracerOptions());
  return relative_noise(tracer, PilotFrame(scene.description().sensor, 1), paths);
}

TEST(Glance, LightThatIsSeenAloneHasNoNoise) {
  EXPECT_NEAR(noise_of(shining(), 512).mean, 0, 1e-12);
}

TEST(Glance, LightBehindAGapHasMoreNoiseThanALampInTheRoom) {
  EXPECT_GT(noise_of(testing::gap_box(), 512).mean, 1);
  EXPECT_LT(noise_of(testing::window_box(), 512).mean, noise_of(testing::gap_box(), 512).mean);
}

TEST(Glance, NoiseIsSurelyLittleOnlyWhereItIsKnown) {
  EXPECT_TRUE((Noise{0.1, 0.02}.surely_below(0.2)));
  EXPECT_FALSE((Noise{0.1, 0.04}.surely_below(0.2)));
  EXPECT_FALSE((Noise{0.01, 0.005}.surely_below(0.2)));
  EXPECT_FALSE((Noise{0, 0}.surely_below(0.2)));  // bright paths that few paths do not find
  EXPECT_FALSE(Noise{}.surely_below(0.2));
}

TEST(Glance, FewerPathsThanSixteenPlacesHaveSayNothing) {
  EXPECT_TRUE(std::isinf(noise_of(shining(), 127).mean));
  EXPECT_FALSE(std::isinf(noise_of(shining(), 128).mean));
}

}  // namespace
}  // namespace waylight
