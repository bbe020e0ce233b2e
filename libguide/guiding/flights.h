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

// Whether a method is the standard one in a medium: equiangular flights are in media that vary, and
// guided ones where options.guides_grids is false.
inline bool is_standard(FlightMethod method, const MediumTracker& medium,
                        const FlightOptions& options) {
  if (method == FlightMethod::standard) return true;
  if (medium.homogeneous()) return false;
  return method == FlightMethod::equiangular ||
         (method == FlightMethod::guided && !options.guides_grids);
}

// By a method that is not the standard one in the medium. equiangular is where no light is near.
Flight sample_flight(FlightMethod method, const Scene& scene, const FlightSpace& space,
                     const FlightOptions& options, Sampler& sampler);

}  // namespace waylight
