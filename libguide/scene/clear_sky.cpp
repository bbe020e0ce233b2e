#include "libguide/scene/clear_sky.h"

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/scene/solar_spectrum.h"

namespace waylight {
namespace {

constexpr float kSunRadius = 0.2666f * kPi / 180;  // angular, mean over the year
constexpr double kLuminousEfficacy = 683;          // lm / W at 555 nm

// A quantity over the sky by its five Perez coefficients, divided by its value at the zenith.
struct Perez {
  double a, b, c, d, e;
  double zenith, normaliser;

  double shape(double cos_theta, double gamma) const {
    const double cos_gamma = std::cos(gamma);
    return (1 + a * std::exp(b / cos_theta)) *
           (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
  }
  double eval(double cos_theta, double gamma) const {
    return zenith * shape(cos_theta, gamma) / normaliser;
  }
};

struct Sky {
  Perez luminance, x, y;
};

double cubic(double theta, double c3, double c2, double c1, double c0) {
  return ((c3 * theta + c2) * theta + c1) * theta + c0;
}

// [Preetham et al. 1999, appendix A.2] at turbidity t; luminance in kcd/m^2.
void set_zenith(Sky& sky, double t, double sun_theta) {
  const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * sun_theta);
  sky.luminance.zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  sky.x.zenith = t * t * cubic(sun_theta, 0.00166, -0.00375, 0.00209, 0) +
                 t * cubic(sun_theta, -0.02903, 0.06377, -0.03202, 0.00394) +
                 cubic(sun_theta, 0.11693, -0.21196, 0.06052, 0.25886);
  sky.y.zenith = t * t * cubic(sun_theta, 0.00275, -0.00610, 0.00317, 0) +
                 t * cubic(sun_theta, -0.04214, 0.08970, -0.04153, 0.00516) +
                 cubic(sun_theta, 0.15346, -0.26756, 0.06670, 0.26688);
}

Sky make_sky(double t, double sun_theta) {
  Sky sky;
  sky.luminance = {0.1787 * t - 1.4630,
                   -0.3554 * t + 0.4275,
                   -0.0227 * t + 5.3251,
                   0.1206 * t - 2.5771,
                   -0.0670 * t + 0.3703,
                   0,
                   1};
  sky.x = {-0.0193 * t - 0.2592,
           -0.0665 * t + 0.0008,
           -0.0004 * t + 0.2125,
           -0.0641 * t - 0.8989,
           -0.0033 * t + 0.0452,
           0,
           1};
  sky.y = {-0.0167 * t - 0.2608,
           -0.0950 * t + 0.0092,
           -0.0079 * t + 0.2102,
           -0.0441 * t - 1.6537,
           -0.0109 * t + 0.0529,
           0,
           1};
  set_zenith(sky, t, sun_theta);
  for (Perez* p : {&sky.luminance, &sky.x, &sky.y}) p->normaliser = p->shape(1, sun_theta);
  return sky;
}

// Mean spectral radiance of a direction of the upper half.
Color sky_radiance(const Sky& sky, const Vec3& w, const Vec3& sun) {
  // The horizon itself is the limit b / cos -> -infinity; below 0.1 degrees nothing changes.
  const double cos_theta = std::max(w.y(), 1e-3f);
  const double gamma = std::atan2(w.cross(sun).norm(), w.dot(sun));
  const double luminance = std::max(0.0, 1000 * sky.luminance.eval(cos_theta, gamma));
  const double x = sky.x.eval(cos_theta, gamma), y = sky.y.eval(cos_theta, gamma);
  const double radiance = luminance / (kLuminousEfficacy * kLuminanceIntegral);
  const Eigen::Array3d xyz = radiance * Eigen::Array3d(x / y, 1, (1 - x - y) / y);
  return xyz_to_linear_srgb(xyz).cast<float>().max(0.0f);
}

void check(const ClearSkyParameters& p) {
  if (!(p.turbidity >= 2 && p.turbidity <= 10))
    fail("sky: turbidity {} is outside of the model's range 2..10", p.turbidity);
  if (!(std::abs(p.sun_direction.norm() - 1) < 1e-3f))
    fail("sky: the direction of the sun must have length 1");
  if (!(p.sun_direction.y() > 0))
    fail("sky: the sun is below the horizon, where the model says nothing; raise it");
  if (!(p.sky_scale >= 0 && p.sun_scale >= 0 && std::isfinite(p.sky_scale + p.sun_scale)))
    fail("sky: its scales must be finite and at least 0");
  if (!(p.sun_radius_scale > 0 && p.sun_radius_scale <= 100))
    fail("sky: sun radius scale {} is outside of 0..100; use a directional light for a point sun",
         p.sun_radius_scale);
  if (p.resolution < 8 || p.resolution > 16384)
    fail("sky: resolution {} is outside of 8..16384", p.resolution);
}

float polar_angle(const Vec3& sun) { return std::acos(std::clamp(sun.y(), -1.0f, 1.0f)); }

}  // namespace

EnvironmentMap bake_clear_sky(const ClearSkyParameters& p) {
  check(p);
  const Sky sky = make_sky(p.turbidity, polar_angle(p.sun_direction));
  auto bitmap = std::make_shared<Bitmap>();
  bitmap->width = p.resolution;
  bitmap->height = p.resolution / 2;
  bitmap->pixels.assign(static_cast<size_t>(bitmap->width) * bitmap->height, Color::Zero());
  parallel_for(bitmap->height / 2, [&](size_t row) {
    const float theta = kPi * (static_cast<float>(row) + 0.5f) / bitmap->height;
    for (int column = 0; column < bitmap->width; ++column) {
      const float phi = 2 * kPi * (static_cast<float>(column) + 0.5f) / bitmap->width;
      const Vec3 w(std::sin(phi) * std::sin(theta), std::cos(theta),
                   -std::cos(phi) * std::sin(theta));
      bitmap->pixels[row * bitmap->width + column] = sky_radiance(sky, w, p.sun_direction);
    }
  });
  return {bitmap, p.sky_scale, p.to_world};
}

DistantDisk make_sun(const ClearSkyParameters& p) {
  check(p);
  const double radius = static_cast<double>(kSunRadius) * p.sun_radius_scale;
  if (radius >= 0.5 * std::numbers::pi)
    fail("sky: the sun would fill half the sky; make it smaller");
  const float cos_angle = static_cast<float>(std::cos(radius));
  if (!(cos_angle < 1))
    fail("sky: sun radius scale {} makes a point of the sun; use a directional light for that",
         p.sun_radius_scale);
  // Over the solid angle that the rounded cosine stands for, the irradiance is that of the true
  // sun.
  const double sun_height = 2 * std::pow(std::sin(0.5 * kSunRadius), 2);
  const double spread = sun_height / (1.0 - cos_angle);
  const Eigen::Array3d xyz = sun_xyz(polar_angle(p.sun_direction), p.turbidity);
  const Color rgb = xyz_to_linear_srgb(xyz).cast<float>().max(0.0f);
  return {(p.to_world * p.sun_direction).normalized(), cos_angle,
          rgb * static_cast<float>(p.sun_scale * spread)};
}

}  // namespace waylight
