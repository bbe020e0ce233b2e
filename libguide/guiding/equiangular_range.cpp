#include "libguide/guiding/equiangular_range.h"

#include <algorithm>
#include <cmath>

#include "libguide/base/random_stream.h"

namespace waylight {
namespace {

constexpr float kReach = 16;      // mean free paths; beyond, other flights are enough
constexpr double kHeight = 1e-5;  // of the range, the least D: keeps densities finite

// Of the thinnest channel that scatters at all; infinite without one.
float mean_free_path(const Color& sigma) {
  float longest = kInfinity;
  for (int c = 0; c < 3; ++c)
    if (sigma[c] > 0)
      longest = std::isinf(longest) ? 1 / sigma[c] : std::max(longest, 1 / sigma[c]);
  return longest;
}

std::optional<Vec3> light_point_from(const Scene& scene, const Vec3& from, RandomStream& random) {
  const float u = random.next();
  const float x = random.next();
  const std::optional<LightSample> light = scene.sample_light(from, u, {x, random.next()});
  if (!light || !std::isfinite(light->distance)) return std::nullopt;
  return Vec3(from + light->distance * light->wi);
}

}  // namespace

std::optional<Vec3> light_point(const Scene& scene, const FlightSpace& space, Sampler& sampler) {
  RandomStream random(sampler);  // which point matters little: its place along the ray does
  const std::optional<Vec3> point = light_point_from(scene, space.ray.origin, random);
  if (point || !std::isfinite(space.t_max)) return point;
  return light_point_from(scene, space.ray(space.t_max), random);
}

EquiangularRange::EquiangularRange(const FlightSpace& space, const Color& sigma,
                                   const Vec3& light) {
  const Vec3 to_light = light - space.ray.origin;
  reach_ = std::min(space.t_max, kReach * mean_free_path(sigma));
  if (!std::isfinite(reach_)) return;
  offset_ = to_light.dot(space.ray.direction);
  const double height = (to_light - static_cast<float>(offset_) * space.ray.direction).norm();
  height_ = std::max(height, kHeight * reach_);
  span_ = std::atan2(height_ * reach_, height_ * height_ - offset_ * (reach_ - offset_));
}

float EquiangularRange::sample(float u) const {
  const double theta_a = std::atan2(-offset_, height_);
  const double t = offset_ + height_ * std::tan(theta_a + u * span_);
  return static_cast<float>(std::clamp(t, 0.0, reach_));
}

float EquiangularRange::pdf(float t) const {
  if (empty() || t > reach_) return 0;
  return static_cast<float>(height_ / (span_ * (height_ * height_ + sqr(t - offset_))));
}

}  // namespace waylight
