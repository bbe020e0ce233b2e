#include "libguide/scene/sphere_view.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

constexpr float kRim = 99.99f;

TEST(SphereView, ShowsUpInTheMiddleAndDownOnTheRim) {
  const SphereView view(Vec3(1, 2, 3), 300, 200);
  const std::optional<Ray> up = view.ray({150, 100}), down = view.ray({150, 100 - kRim});
  ASSERT_TRUE(up && down);
  EXPECT_EQ(up->origin, Vec3(1, 2, 3));
  EXPECT_LT((up->direction - Vec3::UnitZ()).norm(), 1e-6f);
  EXPECT_LT((down->direction + Vec3::UnitZ()).norm(), 0.03f);
}

TEST(SphereView, ShowsXToTheRightAndYUp) {
  const SphereView view(Vec3::Zero(), 200, 200);
  const float horizon = 100 / std::numbers::sqrt2_v<float>;
  EXPECT_LT((view.ray({100 + horizon, 100})->direction - Vec3::UnitX()).norm(), 1e-5f);
  EXPECT_LT((view.ray({100, 100 - horizon})->direction - Vec3::UnitY()).norm(), 1e-5f);
}

TEST(SphereView, ShowsNothingBeyondTheRim) {
  const SphereView view(Vec3::Zero(), 200, 200);
  EXPECT_TRUE(view.ray({100 + kRim, 100}));
  EXPECT_FALSE(view.ray({101 + kRim, 100}));
  EXPECT_FALSE(view.ray({5, 5}));
}

TEST(SphereView, PixelIsWhereTheRayCameFrom) {
  const SphereView view(Vec3::Zero(), 64, 96);
  for (const Vec2 pixel : {Vec2(32.5f, 20), Vec2(10, 50), Vec2(60, 48.25f)})
    EXPECT_LT((view.pixel(direction_to_disk(view.ray(pixel)->direction)) - pixel).norm(), 1e-3f);
}

}  // namespace
}  // namespace waylight
