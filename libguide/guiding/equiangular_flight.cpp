#include "libguide/guiding/equiangular_flight.h"

namespace waylight {
namespace {

constexpr float kEquiangular = 0.5f;

}  // namespace

EquiangularFlight::EquiangularFlight(const FlightSpace& space, const Vec3& light)
    : space_(space),
      sigma_(space.medium.at(space.ray.origin).sigma_t),
      range_(space, sigma_, light),
      share_(range_.empty() ? 0 : kEquiangular) {}

Color EquiangularFlight::transmittance(float t) const {
  return exponential_transmittance(sigma_, t);
}

float EquiangularFlight::standard_distance(const Vec2& u) const {
  const float sigma = sigma_[choose_channel(space_.channels, u.y())];
  return sigma > 0 ? -std::log1p(-u.x()) / sigma : kInfinity;
}

Flight EquiangularFlight::sample(Sampler& sampler) const {
  const bool equiangular = sampler.next() < share_;
  const Vec2 u = sampler.next_2d();
  const float t = equiangular ? range_.sample(u.x()) : standard_distance(u);
  if (!equiangular && !(t < space_.t_max))
    return {space_.t_max, false, transmittance(space_.t_max) / pass_prob(), {}};
  return {t, true, sigma_ * transmittance(t) / pdf(t), space_.medium.at(space_.ray(t))};
}

float EquiangularFlight::pdf(float t) const {
  const float standard = (space_.channels * sigma_ * transmittance(t)).sum();
  return share_ * range_.pdf(t) + (1 - share_) * standard;
}

float EquiangularFlight::pass_prob() const {
  return (1 - share_) * (space_.channels * transmittance(space_.t_max)).sum();
}

}  // namespace waylight
