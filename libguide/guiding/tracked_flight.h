#pragma once
// Guided product distance sampling in media that vary.

#include "libguide/guiding/flight_space.h"

namespace waylight {

// Candidates are all tentative collisions of delta tracking along the ray, whose rate is raised
// where there would be too few. Tracking would take candidate i, the first real collision, with
//   a_i = sigma_i / rate prod_{j < i} (1 - sigma_j / rate),
// and pass with what is left. One is chosen with probability
//   q_i = share a_i / sum a + (1 - share) a_i albedo Li / sum,
// Li the radiance scattered towards the camera as its cell has it, and for passing L, the radiance
// that the last cell sees along the ray. The weight a_i / q_i, by channel, makes the estimate that
// of tracking for any q, and is at most 1 / share in media of one colour: resampling [Talbot et al.
// 2005] with weights that are exact. A density over blocks of mean extinction would put events
// where a block is empty.
class TrackedFlight {
 public:
  TrackedFlight(const FlightSpace& space, const FlightOptions& options)
      : space_(space), options_(options) {}

  Flight sample(Sampler& sampler) const;

 private:
  const FlightSpace& space_;
  FlightOptions options_;
};

}  // namespace waylight
