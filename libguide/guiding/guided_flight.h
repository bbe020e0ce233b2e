#pragma once
// Guided product distance sampling: whether and where a flight through a medium scatters
// [Herholz et al. 2019].

#include "libguide/guiding/flight_space.h"

namespace waylight {

// The density over distance of one flight. Bins are what the ray has in one block of extinction and
// one cell of the cache. The standard process reaches and scatters in bin i with probability
//   m_i = T(0, t_i) (1 - e^(-s d))
// for extinction s and length d; the guided one with
//   m_i albedo Li / sum,
// Li the radiance scattered towards the camera as the cell of the bin has it. It passes with
// T(0, t_max) L / sum, L the radiance that the last cell sees along the ray. Herholz et al. decide
// bin by bin, against the L of each bin's own cell: then what one cell has too low ends the flight
// in it, and thin media, where light from behind is mostly none, suffer; the sum over the ray needs
// no cell to agree with the others about what is behind. Within a bin, both processes place the
// event by the truncated exponential. One process is chosen per flight, and one channel, whose
// extinction it goes by; the density is the sum over them all. So the weight of a flight is at most
// 1 / standard_share times that of the standard process alone, whatever the cache says.
// For homogeneous media; in others the mean of the block stands for the extinction, which is exact
// too but puts events where a block is empty: see TrackedFlight.
class GuidedFlight {
 public:
  GuidedFlight(const FlightSpace& space, const FlightOptions& options)
      : space_(space), options_(options) {}

  Flight sample(Sampler& sampler) const;
  // For tests: per unit length, and the probability to pass.
  float pdf(float t) const;
  float pass_prob() const;

 private:
  struct Plan;

  const FlightSpace& space_;
  FlightOptions options_;
};

}  // namespace waylight
