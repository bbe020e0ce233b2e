#pragma once
// Distances in homogeneous media, half of them near a light [Kulla, Fajardo 2012].

#include "libguide/guiding/equiangular_range.h"

namespace waylight {

// Half of the flights are standard ones, with the exact density of both, so weights are at most
// twice the standard ones. The light is given: the estimate is unbiased for each point of it,
// whatever chose the point.
class EquiangularFlight {
 public:
  EquiangularFlight(const FlightSpace& space, const Vec3& light);

  Flight sample(Sampler& sampler) const;
  // For tests: per unit length, and the probability to pass.
  float pdf(float t) const;
  float pass_prob() const;

 private:
  float standard_distance(const Vec2& u) const;
  Color transmittance(float t) const;

  const FlightSpace& space_;
  Color sigma_;
  EquiangularRange range_;
  float share_;  // of equiangular flights
};

}  // namespace waylight
