#pragma once
// Distances spread evenly over the angle under which a light sees a ray [Kulla, Fajardo 2012].

#include <optional>

#include "libguide/guiding/flight_space.h"
#include "libguide/scene/scene.h"

namespace waylight {

// A point of a light near the ray, as next-event estimation chooses it from the ray's origin, or
// else from its end; none where it chooses distant light.
std::optional<Vec3> light_point(const Scene& scene, const FlightSpace& space, Sampler& sampler);

// With D the distance of the light from the ray's line, and delta the place nearest to it on that
// line,
//   pdf(t) = D / ((theta_b - theta_a) (D^2 + (t - delta)^2)),
// the inverse of the squared distance up to its norm, between the ray's origin and its end, or some
// mean free paths where that is nearer.
class EquiangularRange {
 public:
  EquiangularRange() = default;  // empty
  // sigma: extinction of the medium, per unit length.
  EquiangularRange(const FlightSpace& space, const Color& sigma, const Vec3& light);

  bool empty() const { return !(span_ > 0); }
  float angle() const { return static_cast<float>(span_); }  // theta_b - theta_a, in [0, pi]
  // u in [0, 1). Of ranges that are not empty.
  float sample(float u) const;
  float pdf(float t) const;  // per unit length; 0 outside of the range

 private:
  double reach_ = 0;   // where the range ends
  double offset_ = 0;  // delta
  double height_ = 0;  // D
  double span_ = 0;    // theta_b - theta_a
};

}  // namespace waylight
