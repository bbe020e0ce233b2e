#include "libguide/math/warp.h"

#include "statistical/density_assertions.h"

namespace waylight {
namespace {

using testing::Disk;
using testing::expect_valid_density;
using testing::Sphere;

template <typename Forward, typename Inverse>
void expect_round_trip(const Forward& forward, const Inverse& inverse, float tolerance) {
  for (int i = 0; i < 4096; ++i) {
    const Vec2 u = Sampler(5, 0, i).next_2d();
    const Vec2 back = inverse(forward(u));
    EXPECT_NEAR(back.x(), u.x(), tolerance) << u.transpose();
    EXPECT_NEAR(back.y(), u.y(), tolerance) << u.transpose();
  }
}

template <typename Forward>
auto sampled(const Forward& forward) {
  return [=](Sampler& s) { return std::make_optional(forward(s.next_2d())); };
}

TEST(Warp, DiskRoundTripAndDensity) {
  expect_round_trip(square_to_disk, disk_to_square, 1e-6f);
  expect_valid_density(Disk{}, "disk", sampled(square_to_disk), [](const Vec2&) { return kInvPi; });
}

TEST(Warp, DiskKeepsCornersEdgesAndCentre) {
  for (float x : {0.0f, 0.5f, 1.0f})
    for (float y : {0.0f, 0.5f, 1.0f}) {
      const Vec2 p = square_to_disk({x, y});
      EXPECT_NEAR(p.norm(), x == 0.5f && y == 0.5f ? 0 : 1, 1e-6f);
      EXPECT_LT((disk_to_square(p) - Vec2(x, y)).norm(), 1e-5f) << x << " " << y;
    }
}

TEST(Warp, CosineHemisphereHasItsDensity) {
  expect_valid_density(Sphere{}, "cosine", sampled(square_to_cosine_hemisphere),
                       cosine_hemisphere_pdf);
}

TEST(Warp, SphereRoundTripAndDensity) {
  expect_round_trip(square_to_sphere, sphere_to_square, 2e-4f);
  expect_valid_density(Sphere{}, "sphere", sampled(square_to_sphere),
                       [](const Vec3&) { return kSpherePdf; });
}

TEST(Warp, LambertMapRoundTripsOverTheSphere) {
  for (int i = 0; i < 4096; ++i) {
    const Vec3 w = square_to_sphere(Sampler(6, 0, i).next_2d());
    const Vec2 y = direction_to_disk(w);
    EXPECT_LE(y.squaredNorm(), kDiskMaxRadius2 * (1 + 1e-6f));
    EXPECT_LT((disk_to_direction(y) - w).norm(), 2e-5f) << w.transpose();
  }
}

TEST(Warp, LambertMapIsEqualArea) {
  // Uniform on the sphere is uniform on the disk of radius sqrt(2).
  expect_valid_density(
      Disk{kDiskMaxRadius2}, "lambert",
      [](Sampler& s) {
        return std::make_optional(direction_to_disk(square_to_sphere(s.next_2d())));
      },
      [](const Vec2&) { return kSpherePdf * kSteradianPerDiskArea; });
}

TEST(Warp, LambertMapCarriesAzimuthalRotation) {
  const Eigen::AngleAxisf turn(0.7f, Vec3::UnitZ());
  const Vec3 w = Vec3(0.3f, -0.5f, 0.4f).normalized();
  const Vec2 rotated = Eigen::Rotation2Df(0.7f) * direction_to_disk(w);
  EXPECT_LT((direction_to_disk(turn * w) - rotated).norm(), 1e-6f);
}

}  // namespace
}  // namespace waylight
