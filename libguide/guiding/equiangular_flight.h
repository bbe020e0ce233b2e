#pragma once
// Distances spread evenly over the angle under which a light sees the ray [Kulla, Fajardo 2012].

#include <optional>

#include "libguide/guiding/flight_space.h"
#include "libguide/scene/scene.h"

namespace waylight {

// A point of a light near the ray, as next-event estimation chooses it from the ray's origin, or
// else from its end; none where it chooses distant light.
std::optional<Vec3> light_point(const Scene& scene, const FlightSpace& space, Sampler& sampler);

// In homogeneous media. With D the distance of the light from the ray's line, and delta the place
// nearest to it on that line,
//   pdf(t) = D / ((theta_b - theta_a) (D^2 + (t - delta)^2)),
// the inverse of the squared distance up to its norm. Half of the flights are standard ones, with
// the exact density of both, so weights are at most twice the standard ones. The light is
// given: the estimate is unbiased for each point of it, whatever chose the point.
class EquiangularFlight {
 public:
  EquiangularFlight(const FlightSpace& space, const Vec3& light);

  Flight sample(Sampler& sampler) const;
  // For tests: per unit length, and the probability to pass.
  float pdf(float t) const;
  float pass_prob() const;

 private:
  float equiangular_distance(float u) const;
  float standard_distance(const Vec2& u) const;
  Color transmittance(float t) const;

  const FlightSpace& space_;
  Color sigma_;
  float share_;     // of equiangular flights
  double reach_;    // where their range ends
  double offset_;   // delta
  double height_;   // D
  double theta_a_;  // angle of the range's start as the light sees it, 0 towards the nearest place
  double span_;     // theta_b - theta_a
};

}  // namespace waylight
