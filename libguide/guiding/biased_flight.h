#pragma once
// Exponential biasing: distances by a multiple of the extinction, also path stretching
// [Lux, Koblinger 1991].

#include "libguide/guiding/flight_space.h"

namespace waylight {

// Half of the flights go by the extinction s and half by bias * s, with the density of both,
//   pdf(t) = (s e^(-tau) + bias s e^(-bias tau)) / 2,  tau the optical depth of s up to t,
// the mean over the channels, of which a flight goes by one. So weights are at most twice those of
// the standard method alone. In media that vary, s is the mean of the block: the density is still
// exact, and the transmittance in the weight an unbiased estimate.
class BiasedFlight {
 public:
  BiasedFlight(const FlightSpace& space, const FlightOptions& options)
      : space_(space), bias_(options.bias) {}

  Flight sample(Sampler& sampler) const;
  // For tests: per unit length, and the probability to pass.
  float pdf(float t) const;
  float pass_prob() const;

 private:
  Color sigma(const RayBlock& block) const;
  float pdf(const Color& sigma, const Color& depth) const;
  float pass_prob(const Color& depth) const;
  BlockWalk walk() const;

  const FlightSpace& space_;
  float bias_;
};

}  // namespace waylight
