#pragma once
// What a few paths all over the frame tell before a render.

#include <cstdint>

#include "libguide/transport/path_tracer.h"
#include "libguide/transport/pilot_frame.h"

namespace waylight {

// Smooth scatterings of a few paths.
struct Glance {
  uint64_t scatterings = 0, guided = 0, in_grids = 0;

  double guided_share() const { return scatterings > 0 ? double(guided) / double(scatterings) : 1; }
  double share_in_grids() const {
    return scatterings > 0 ? double(in_grids) / double(scatterings) : 0;
  }
};

Glance glance(const PathTracer& tracer, const PilotFrame& frame, int paths);

// Variance of a path over the squared value of its pixel, as in relMSE; infinite: not known.
struct Noise {
  double mean = kInfinity, error = 0;  // over places, and its standard error

  // By three standard errors, if there is noise and it is known at all: rare bright paths make it
  // vague, or are not among them.
  bool surely_below(double most) const { return error < 0.4 * mean && mean + 3 * error < most; }
};

// The mean of as many places as `paths` reach for with eight each, at most 64; not known where they
// do not reach for 16.
Noise relative_noise(const PathTracer& tracer, const PilotFrame& frame, uint64_t paths);

}  // namespace waylight
