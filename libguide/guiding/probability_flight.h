#pragma once
// Volume scattering probability guiding: the guide decides whether a flight scatters, the standard
// method where [Xu et al. 2024].

#include "libguide/guiding/flight_space.h"

namespace waylight {

// Let f be what is carried on from a scattering and g what is from behind. Standard methods make,
// for one ray, candidates x_i with weights w_i and a weight w' of passing, such that
//   E[sum w_i f(x_i)] = int T sigma_t f dt   and   E[w'] = T(t_max);
// in homogeneous media one candidate, of the exponential cut off at the ray's end; in others all
// tentative collisions of the majorant process along the ray [Woodcock et al. 1965], with the
// chance to be the first that is real,
//   w_i = sigma_i / majorant prod_{j < i} (1 - sigma_j / majorant),
// and w' = prod_j (1 - sigma_j / majorant). Given the candidates, scattering with any chance Q at
// one in proportion to w_i, with weight sum w / Q, or else passing with w' / (1 - Q), has the mean
// sum w_i f(x_i) + w' g: so the estimate is unbiased as long as Q is 0 or 1 only where sum w or w'
// is 0. The standard method is Q = S = sum w / (sum w + w'). Here
//   Q = share S + (1 - share) P,
// P the chance to scatter at all of the guided process (guided_flight.h), so weights are at most
// 1 / share times the standard ones whatever the cache says. Colours have weights each, of which Q
// and the choice of the candidate take the mean by `channels`.
class ProbabilityFlight {
 public:
  ProbabilityFlight(const FlightSpace& space, const FlightOptions& options)
      : space_(space), options_(options) {}

  Flight sample(Sampler& sampler) const;
  // For tests, in homogeneous media: per unit length, and the probability to pass.
  float pdf(float t) const;
  float pass_prob() const;

 private:
  float scatter_prob(float scatter_mass, float pass_mass) const;  // Q

  const FlightSpace& space_;
  FlightOptions options_;
};

}  // namespace waylight
