#include "libguide/scene/camera.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"

namespace waylight {
namespace {

SensorDescription sensor(int width, int height) {
  SensorDescription s;
  s.film.width = width;
  s.film.height = height;
  s.fov = kPi / 2;
  return s;
}

TEST(Camera, SeesPlusXOnTheLeftAndPlusYOnTop) {
  const Camera camera(sensor(200, 100));
  const Vec3 left_top = camera.ray({50, 25}, {0, 0}).direction;
  EXPECT_GT(left_top.x(), 0);
  EXPECT_GT(left_top.y(), 0);
  EXPECT_GT(left_top.z(), 0);
}

TEST(Camera, CentreOfTheFilmLooksAlongZ) {
  const Vec3 w = Camera(sensor(200, 100)).ray({100, 50}, {0, 0}).direction;
  EXPECT_NEAR((w - Vec3::UnitZ()).norm(), 0, 1e-6);
}

TEST(Camera, FieldOfViewSpansTheWidth) {
  const Camera camera(sensor(200, 100));
  const Vec3 left = camera.ray({0, 50}, {0, 0}).direction;
  const Vec3 top = camera.ray({100, 0}, {0, 0}).direction;
  EXPECT_NEAR(left.x() / left.z(), 1, 1e-6);
  EXPECT_NEAR(top.y() / top.z(), 0.5, 1e-6);
}

TEST(Camera, StandsWhereItsTransformSays) {
  SensorDescription s = sensor(10, 10);
  s.to_world.topLeftCorner<3, 3>() =
      Eigen::AngleAxisf(kPi / 2, Vec3::UnitY()).toRotationMatrix();  // z to x
  s.to_world.topRightCorner<3, 1>() = Vec3(1, 2, 3);
  const Ray ray = Camera(s).ray({5, 5}, {0, 0});
  EXPECT_NEAR((ray.origin - Vec3(1, 2, 3)).norm(), 0, 1e-6);
  EXPECT_NEAR((ray.direction - Vec3::UnitX()).norm(), 0, 1e-6);
}

TEST(Camera, ThinLensRaysOfOnePixelMeetInTheFocalPlane) {
  SensorDescription s = sensor(200, 100);
  s.aperture_radius = 0.3f;
  s.focus_distance = 5;
  const Camera camera(s);
  const Ray a = camera.ray({30, 70}, {0.1f, 0.9f}), b = camera.ray({30, 70}, {0.8f, 0.3f});
  EXPECT_GT((a.origin - b.origin).norm(), 0.1f);
  const Vec3 at_a = a(5 / a.direction.z()), at_b = b(5 / b.direction.z());
  EXPECT_NEAR((at_a - at_b).norm(), 0, 1e-5);
}

TEST(Camera, PrincipalOffsetMovesTheView) {
  SensorDescription s = sensor(200, 100);
  s.principal_x = 0.25f;
  EXPECT_NEAR((Camera(s).ray({50, 50}, {0, 0}).direction - Vec3::UnitZ()).norm(), 0, 1e-6);
}

TEST(Camera, RefusesAnImpossibleFieldOfView) {
  SensorDescription s = sensor(200, 100);
  s.fov = kPi;
  EXPECT_THROW(Camera{s}, Error);
}

}  // namespace
}  // namespace waylight
