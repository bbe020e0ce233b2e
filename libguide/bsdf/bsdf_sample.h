#pragma once
// The contract of every BSDF lobe.
//
// Directions are unit vectors of the local shading frame (z = ns), both pointing away from the
// surface: `wo` to where light leaves (the camera side of a camera path), `wi` to where it comes
// from. A lobe is a plain struct with its parameters already evaluated at the shading point:
//
//   Color eval(wo, wi)  the smooth part of f(wo, wi) |cos wi|, 1/sr; zero for delta parts
//   std::optional<BsdfSample> sample(wo, u, u2)  a direction of the smooth part
//   float pdf(wo, wi)   density per steradian with which sample() makes wi
//   float delta_prob(wo)  in [0, 1]: probability with which the delta part should be chosen before
//                       (0: no delta part; 1: nothing but delta)
//   std::optional<BsdfSample> sample_delta(wo, u)  one of the delta directions
//   Color mean_reflectance()  rough directional-hemispherical albedo, for statistics
//
// `pdf` is conditional on the smooth part having been chosen, `sample_delta`'s weight on the delta
// part having been chosen. An empty optional means "no sample": the path ends.

#include <optional>

#include "libguide/math/types.h"

namespace waylight {

struct BsdfSample {
  Vec3 wi;
  Color weight;   // smooth: eval / pdf; delta: f / probability of this direction
  float pdf = 0;  // smooth: per steradian; delta: discrete probability
  float eta = 1;  // n(side of wi) / n(side of wo) when refracted, else 1
  bool straight = false;  // wi = -wo: through a pane, which next-event estimation sees through too
};

// Shares of light, luminance in [0, 1], that come from the side of wo and from the other.
struct SideShares {
  float reflected = 0, transmitted = 0;
};

// Radiance travels against light (camera paths), importance with it (photons). Refraction scales
// radiance by 1/eta^2 and leaves power unchanged [Veach 1997, section 5.2].
enum class TransportMode { radiance, importance };

}  // namespace waylight
