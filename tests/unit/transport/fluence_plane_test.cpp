// Pictures of the fluence over a plane.

#include "libguide/transport/fluence_plane.h"

#include <gtest/gtest.h>

#include "common/small_media.h"

namespace waylight {
namespace {

// A box of fog, [-1, 1] x [0, 1] x [2, 6].
Scene fog() {
  return Scene(testing::box_of(testing::homogeneous(Color::Ones(), Color::Constant(0.5f)),
                               {-1, 0, 2}, {1, 1, 6}));
}

TEST(FluencePlane, ShowsAllOfTheMediaWithSquarePixels) {
  const Scene scene = fog();
  const FluencePlane across_z(scene, {2, 3.5f, false}, 20, 20);
  EXPECT_LT((across_z.point({0, 0}) - Vec3(-1, 1.5f, 3.5f)).norm(), 1e-6f);  // left, above the box
  EXPECT_LT((across_z.point({20, 20}) - Vec3(1, -0.5f, 3.5f)).norm(), 1e-6f);
  const FluencePlane across_x(scene, {0, 0.5f, false}, 40, 10);
  EXPECT_LT((across_x.point({0, 0}) - Vec3(0.5f, 1, 2)).norm(), 1e-6f);
  EXPECT_LT((across_x.point({40, 10}) - Vec3(0.5f, 0, 6)).norm(), 1e-6f);
  const FluencePlane across_y(scene, {1, 0.5f, false}, 20, 40);
  EXPECT_LT((across_y.point({0, 0}) - Vec3(-1, 0.5f, 6)).norm(), 1e-6f);
}

TEST(FluencePlane, BesideTheMediaIsRefused) {
  const Scene scene = fog();
  EXPECT_ANY_THROW(FluencePlane(scene, {2, 1.9f, false}, 20, 20));
  EXPECT_NO_THROW(FluencePlane(scene, {2, 2.1f, false}, 20, 20));
  SceneDescription bare;
  testing::add_shape(bare, Sphere{}, kNone);
  EXPECT_ANY_THROW(FluencePlane(Scene(bare), {2, 0, false}, 20, 20));
}

}  // namespace
}  // namespace waylight
