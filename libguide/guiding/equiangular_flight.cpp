#include "libguide/guiding/equiangular_flight.h"

namespace waylight {
namespace {

constexpr float kReach = 16;      // mean free paths; beyond, the standard half is enough
constexpr double kHeight = 1e-5;  // of the range, the least D: keeps densities finite
constexpr float kEquiangular = 0.5f;

// Of the thinnest channel that scatters at all; infinite without one.
float mean_free_path(const Color& sigma) {
  float longest = kInfinity;
  for (int c = 0; c < 3; ++c)
    if (sigma[c] > 0)
      longest = std::isinf(longest) ? 1 / sigma[c] : std::max(longest, 1 / sigma[c]);
  return longest;
}

std::optional<Vec3> light_point_from(const Scene& scene, const Vec3& from, Sampler& sampler) {
  const float u = sampler.next();
  const std::optional<LightSample> light = scene.sample_light(from, u, sampler.next_2d());
  if (!light || !std::isfinite(light->distance)) return std::nullopt;
  return Vec3(from + light->distance * light->wi);
}

}  // namespace

std::optional<Vec3> light_point(const Scene& scene, const FlightSpace& space, Sampler& sampler) {
  const std::optional<Vec3> point = light_point_from(scene, space.ray.origin, sampler);
  if (point || !std::isfinite(space.t_max)) return point;
  return light_point_from(scene, space.ray(space.t_max), sampler);
}

EquiangularFlight::EquiangularFlight(const FlightSpace& space, const Vec3& light)
    : space_(space), sigma_(space.medium.at(space.ray.origin).sigma_t) {
  const Vec3 to_light = light - space.ray.origin;
  reach_ = std::min(space.t_max, kReach * mean_free_path(sigma_));
  offset_ = to_light.dot(space.ray.direction);
  const double height = (to_light - static_cast<float>(offset_) * space.ray.direction).norm();
  height_ = std::max(height, kHeight * reach_);
  theta_a_ = std::atan2(-offset_, height_);
  span_ = std::atan2(reach_ - offset_, height_) - theta_a_;
  share_ = std::isfinite(reach_) && span_ > 0 ? kEquiangular : 0;
}

Color EquiangularFlight::transmittance(float t) const {
  return (-sigma_ * std::min(t, kFar)).exp();
}

float EquiangularFlight::equiangular_distance(float u) const {
  const double t = offset_ + height_ * std::tan(theta_a_ + u * span_);
  return static_cast<float>(std::clamp(t, 0.0, reach_));
}

float EquiangularFlight::standard_distance(const Vec2& u) const {
  float left = u.y();
  int channel = 0;
  while (channel < 2 && left >= space_.channels[channel]) left -= space_.channels[channel++];
  const float sigma = sigma_[channel];
  return sigma > 0 ? -std::log1p(-u.x()) / sigma : kInfinity;
}

Flight EquiangularFlight::sample(Sampler& sampler) const {
  const bool equiangular = sampler.next() < share_;
  const Vec2 u = sampler.next_2d();
  const float t = equiangular ? equiangular_distance(u.x()) : standard_distance(u);
  if (!equiangular && !(t < space_.t_max))
    return {space_.t_max, false, transmittance(space_.t_max) / pass_prob(), {}};
  return {t, true, sigma_ * transmittance(t) / pdf(t), space_.medium.at(space_.ray(t))};
}

float EquiangularFlight::pdf(float t) const {
  const float standard = (space_.channels * sigma_ * transmittance(t)).sum();
  if (!(share_ > 0) || t > reach_) return (1 - share_) * standard;
  const double equiangular = height_ / (span_ * (height_ * height_ + sqr(t - offset_)));
  return share_ * static_cast<float>(equiangular) + (1 - share_) * standard;
}

float EquiangularFlight::pass_prob() const {
  return (1 - share_) * (space_.channels * transmittance(space_.t_max)).sum();
}

}  // namespace waylight
