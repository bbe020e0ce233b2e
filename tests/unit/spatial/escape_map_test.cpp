// Rays that leave the scene find their places, and distant emitters find the same ones back.

#include "libguide/spatial/escape_map.h"

#include <gtest/gtest.h>

#include <map>

#include "libguide/base/sampler.h"
#include "libguide/math/warp.h"
#include "libguide/scene/delta_emitter.h"

namespace waylight {
namespace {

const Bounds kBounds{Vec3(-3, 1, 2), Vec3(5, 4, 9)};

TEST(EscapeMap, PlacesAreTheNumbersThatSendALightParticleBackAlongTheRay) {
  const EscapeMap map(kBounds);
  const SceneSphere sphere(kBounds);
  Sampler sampler(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 to_light = square_to_sphere(sampler.next_2d());
    const Vec2 u = sampler.next_2d();
    const Ray entering = enter_scene(sphere, -to_light, u);
    const Vec2 found = map.position(entering(sampler.next() * 20), to_light);
    EXPECT_NEAR(found.x(), u.x(), 1e-4f);
    EXPECT_NEAR(found.y(), u.y(), 1e-4f);
  }
  EXPECT_FLOAT_EQ(map.disk_area(), sphere.cross_section());
}

TEST(EscapeMap, BinsHaveEqualSolidAngles) {
  std::map<uint32_t, int> counts;
  constexpr int kSide = 512;
  for (int i = 0; i < kSide * kSide; ++i)
    ++counts[EscapeMap::bin(
        square_to_sphere({(i % kSide + 0.5f) / kSide, (float(i / kSide) + 0.5f) / kSide}))];
  EXPECT_EQ(counts.size(), EscapeMap::kBins);
  const double mean = double(kSide) * kSide / EscapeMap::kBins;
  for (const auto& [bin, count] : counts) EXPECT_NEAR(count, mean, 0.35 * mean) << bin;
}

TEST(EscapeMap, RaysBesideTheDiskAndAPointlikeSceneFindAPlace) {
  const EscapeMap map(kBounds), point(Bounds{Vec3::Zero(), Vec3::Zero()}), none{Bounds()};
  for (const EscapeMap& m : {map, point, none}) {
    const Vec2 p = m.position(Vec3(1e6f, -1e6f, 3), Vec3::UnitX());
    EXPECT_LT(EscapeMap::cell(p), EscapeMap::kCells);
  }
}

}  // namespace
}  // namespace waylight
