#include "libguide/scene/clear_sky.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"
#include "libguide/scene/solar_spectrum.h"

namespace waylight {
namespace {

ClearSkyParameters at_elevation(float degrees, float turbidity = 3) {
  ClearSkyParameters p;
  p.sun_direction = Vec3(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0);
  p.turbidity = turbidity;
  p.resolution = 128;
  return p;
}

// Irradiance on the ground.
Color irradiance(const EnvironmentMap& map) {
  Color sum = Color::Zero();
  const Bitmap& b = *map.bitmap;
  for (int y = 0; y < b.height / 2; ++y)
    for (int x = 0; x < b.width; ++x) {
      const float theta = kPi * (y + 0.5f) / b.height;
      sum +=
          b.at(x, y) * (std::cos(theta) * std::sin(theta) * 2 * kPi * kPi / (b.width * b.height));
    }
  return map.scale * sum;
}

TEST(ClearSky, IsFiniteAboveAndBlackBelowTheHorizon) {
  for (const float elevation : {0.5f, 20.0f, 89.9f})
    for (const float turbidity : {2.0f, 10.0f}) {
      const EnvironmentMap map = bake_clear_sky(at_elevation(elevation, turbidity));
      const Bitmap& b = *map.bitmap;
      for (int y = 0; y < b.height; ++y)
        for (int x = 0; x < b.width; ++x) {
          ASSERT_TRUE(is_finite(b.at(x, y)) && b.at(x, y).minCoeff() >= 0);
          ASSERT_EQ(y<b.height / 2, b.at(x, y).maxCoeff()> 0) << x << ' ' << y;
        }
    }
}

TEST(ClearSky, IsBlueAwayFromTheSunAndBrightestBesideIt) {
  const EnvironmentMap map = bake_clear_sky(at_elevation(45));
  const Bitmap& b = *map.bitmap;
  const Color zenith = b.at(0, 0);
  EXPECT_GT(zenith.z(), 1.3f * zenith.x());
  // The sun stands at (1, 1, 0): column u = 1/4, row v = 1/4.
  const Color beside = b.at(b.width / 4, b.height / 4),
              opposite = b.at(3 * b.width / 4, b.height / 4);
  EXPECT_GT(luminance(beside), 3 * luminance(opposite));
}

// Clear-sky illuminance is 10..20 klx diffuse and about 75 klx direct with the sun high up; 683
// lm/W over the 106.857 nm of the luminance function turn one of our units into 73 klx per unit.
TEST(ClearSky, IlluminanceIsThatOfAClearDay) {
  const ClearSkyParameters p = at_elevation(60);
  const float lux_per_unit = 683 * 106.857f;
  const float diffuse = lux_per_unit * luminance(irradiance(bake_clear_sky(p)));
  EXPECT_GT(diffuse, 8e3f);
  EXPECT_LT(diffuse, 40e3f);
  const DistantDisk sun = make_sun(p);
  const float direct = lux_per_unit * luminance(sun.radiance) * 2 * kPi * (1 - sun.cos_angle);
  EXPECT_GT(direct, 60e3f);
  EXPECT_LT(direct, 110e3f);
}

TEST(ClearSky, SunReddensTowardsTheHorizon) {
  const Color high = make_sun(at_elevation(80)).radiance, low = make_sun(at_elevation(5)).radiance;
  EXPECT_LT(high.x() / high.z(), 1.6f);
  EXPECT_GT(low.x() / low.z(), 3.0f);
  EXPECT_GT(high.minCoeff(), low.maxCoeff());
}

TEST(ClearSky, RadiusOfTheSunKeepsItsIrradiance) {
  ClearSkyParameters p = at_elevation(50);
  const auto direct = [&] {
    const DistantDisk sun = make_sun(p);
    return sun.radiance.y() * 2 * kPi * (1 - sun.cos_angle);
  };
  const float small = direct();
  p.sun_radius_scale = 20;
  EXPECT_NEAR(direct(), small, 1e-4f * small);
}

TEST(ClearSky, ScalesAndTurns) {
  ClearSkyParameters p = at_elevation(50);
  p.sun_scale = 3;
  p.sky_scale = 2;
  p.to_world = Eigen::AngleAxisf(kPi / 2, Vec3::UnitX()).toRotationMatrix();  // y up to z up
  EXPECT_EQ(bake_clear_sky(p).scale, 2);
  const DistantDisk sun = make_sun(p);
  EXPECT_NEAR(sun.to_light.z(), std::sin(50 * kPi / 180), 1e-5);
  EXPECT_NEAR(sun.radiance.y(), 3 * make_sun(at_elevation(50)).radiance.y(), 1);
}

TEST(ClearSky, RefusesWhatTheModelDoesNotCover) {
  EXPECT_THROW(bake_clear_sky(at_elevation(-1)), Error);
  EXPECT_THROW(bake_clear_sky(at_elevation(30, 1)), Error);
  ClearSkyParameters p = at_elevation(30);
  for (const float no_disk : {0.0f, 0.03f}) {  // the cosine of the latter rounds to one
    p.sun_radius_scale = no_disk;
    EXPECT_THROW(make_sun(p), Error);
  }
  p.sun_radius_scale = 0.06f;
  EXPECT_LT(make_sun(p).cos_angle, 1);
}

TEST(SolarSpectrum, WhitePointIsWhite) {
  const Eigen::Array3d white = xyz_to_linear_srgb({0.95047, 1, 1.08883});
  EXPECT_NEAR((white - 1).abs().maxCoeff(), 0, 1e-3);
}

}  // namespace
}  // namespace waylight
