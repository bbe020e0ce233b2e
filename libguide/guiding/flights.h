#pragma once
// The ways to sample distances in media, behind one function.

#include "libguide/guiding/flight_space.h"
#include "libguide/scene/scene.h"

namespace waylight {

// guided and probability need the caches of media.
enum class FlightMethod { standard, guided, probability, equiangular, exponential };

inline bool needs_guides(FlightMethod method) {
  return method == FlightMethod::guided || method == FlightMethod::probability;
}

// equiangular is standard in media that vary, and where no light is near.
Flight sample_flight(FlightMethod method, const Scene& scene, const FlightSpace& space,
                     const FlightOptions& options, Sampler& sampler);

}  // namespace waylight
