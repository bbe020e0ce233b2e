#pragma once
// Guided product distance sampling: whether and where a flight through a medium scatters
// [Herholz et al. 2019].

#include "libguide/guiding/flight_space.h"

namespace waylight {

// The density over distance of one flight, worked off bin by bin until the event. Bins are what the
// ray has in one block of extinction and one cell of the cache. In a bin of extinction s and length
// d the guided process scatters with probability
//   P = (1 - e^(-s d)) albedo Li / L,
// Li the radiance scattered towards the camera and L the radiance that comes along the ray, both at
// the start of the bin; the standard process with 1 - e^(-s d). Within a bin, both place the event
// by the truncated exponential. One process is chosen per flight, and one channel, whose extinction
// it goes by; the density is the sum over them all. So the weight of a flight is at most
// 1 / standard_share times that of the standard process alone, whatever the cache says.
// In media that vary, s is the mean of the block: the density is still exact, and the transmittance
// in the weight an unbiased estimate.
class GuidedFlight {
 public:
  GuidedFlight(const FlightSpace& space, const FlightOptions& options)
      : space_(space), options_(options) {}

  Flight sample(Sampler& sampler) const;
  // For tests: per unit length, and the probability to pass.
  float pdf(float t) const;
  float pass_prob() const;

 private:
  const FlightSpace& space_;
  FlightOptions options_;
};

}  // namespace waylight
