#include "libguide/guiding/probability_flight.h"

#include "libguide/guiding/guided_flight.h"
#include "libguide/medium/faint_roulette.h"
#include "libguide/medium/tentative_collisions.h"

namespace waylight {
namespace {

// What the standard method makes for a ray.
struct Standard {
  Flight candidate;  // chosen; its weight is per unit of scatter_mass
  float scatter_mass = 0;
  Color pass_weight = Color::Ones();
};

Color homogeneous_transmittance(const FlightSpace& space, float t) {
  return exponential_transmittance(space.medium.at(space.ray.origin).sigma_t, t);
}

// For each channel 1 - T(t_max), exact for thin media too.
Color scattered_share(const FlightSpace& space) {
  const Color sigma = space.medium.at(space.ray.origin).sigma_t;
  Color share;
  for (int c = 0; c < 3; ++c) share[c] = -std::expm1(-sigma[c] * std::min(space.t_max, kFar));
  return share;
}

// By the exponential of one channel, chosen by its share of the mass.
Standard place(const FlightSpace& space, const Vec2& u) {
  Standard result;
  result.pass_weight = homogeneous_transmittance(space, space.t_max);
  const Color share = scattered_share(space), mass = space.channels * share;
  result.scatter_mass = mass.sum();
  if (!(result.scatter_mass > 0)) return result;
  const int channel = choose_channel(mass, u.y() * result.scatter_mass);
  const Color sigma = space.medium.at(space.ray.origin).sigma_t;
  const float t = std::min(-std::log1p(-u.x() * share[channel]) / sigma[channel], space.t_max);
  const Color density = sigma * homogeneous_transmittance(space, t);
  result.candidate = {t, true, density / (space.channels * density).sum(),
                      space.medium.at(space.ray(t))};
  return result;
}

// All tentative collisions of a ray, of which a reservoir keeps one.
class Sweep {
 public:
  Sweep(const FlightSpace& space, Sampler& sampler) : space_(space), random_(sampler) {}

  Standard run() {
    tentative_collisions(space_.medium.walk(space_.ray, space_.t_max), 1, random_.next(), random_,
                         [&](float t, float majorant) {
                           consider(t, majorant);
                           return goes_on();
                         });
    return result_;
  }

 private:
  void consider(float t, float majorant) {
    const MediumCoefficients here = space_.medium.at(space_.ray(t));
    const Color real = (here.sigma_t / majorant).min(1.0f);
    const Color weight = result_.pass_weight * real;
    const float mass = (space_.channels * weight).sum();
    result_.pass_weight *= 1 - real;
    if (!(mass > 0)) return;
    result_.scatter_mass += mass;
    if (random_.next() * result_.scatter_mass < mass)
      result_.candidate = {t, true, weight / mass, here};
  }
  // Roulette ends the sweep where hardly any light comes through.
  bool goes_on() {
    constexpr float kFaint = 0.05f;
    const float left = (space_.channels * result_.pass_weight).sum();
    result_.pass_weight *= faint_roulette(left, kFaint, random_);
    return !is_black(result_.pass_weight);
  }

  const FlightSpace& space_;
  RandomStream random_;
  Standard result_;
};

}  // namespace

float ProbabilityFlight::scatter_prob(float scatter_mass, float pass_mass) const {
  if (!(scatter_mass > 0)) return 0;
  if (!(pass_mass > 0)) return 1;
  const float guided = 1 - std::clamp(GuidedFlight(space_, {0}).pass_prob(), 0.0f, 1.0f);
  const float standard = scatter_mass / (scatter_mass + pass_mass);
  return options_.standard_share * standard + (1 - options_.standard_share) * guided;
}

Flight ProbabilityFlight::sample(Sampler& sampler) const {
  const float u = sampler.next();
  const Vec2 u_place = sampler.next_2d();
  const Standard standard =
      space_.medium.homogeneous() ? place(space_, u_place) : Sweep(space_, sampler).run();
  const float scatter = standard.scatter_mass;
  const float prob = scatter_prob(scatter, (space_.channels * standard.pass_weight).sum());
  if (u >= prob) return {space_.t_max, false, standard.pass_weight / (1 - prob), {}};
  Flight flight = standard.candidate;
  flight.weight *= scatter / prob;
  return flight;
}

float ProbabilityFlight::pdf(float t) const {
  if (!(t >= 0 && t < space_.t_max)) return 0;
  const Color sigma = space_.medium.at(space_.ray.origin).sigma_t;
  const float density = (space_.channels * sigma * homogeneous_transmittance(space_, t)).sum();
  return density > 0
             ? density * (1 - pass_prob()) / (space_.channels * scattered_share(space_)).sum()
             : 0;
}

float ProbabilityFlight::pass_prob() const {
  const Color passed = homogeneous_transmittance(space_, space_.t_max);
  return 1 - scatter_prob((space_.channels * scattered_share(space_)).sum(),
                          (space_.channels * passed).sum());
}

}  // namespace waylight
