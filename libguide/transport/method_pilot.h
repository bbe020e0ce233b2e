#pragma once
// Which of several ways to trace paths has the least variance times cost, from a small render.

#include <functional>
#include <vector>

#include "libguide/records/method_figures.h"
#include "libguide/transport/path_tracer.h"
#include "libguide/transport/pilot_frame.h"

namespace waylight {

struct PilotArm {
  MethodFigures figures;
  PathTracerOptions options;
  bool held = true;  // whether its single bright paths are
};

struct MethodPilotOptions {
  uint64_t max_paths = 0;  // in all
  // Cost is processor time; else rays and vertices with a guide, which is the same every time.
  bool timed = false;
};

// Whether so many paths, of all arms, reach for two looks of one of them at a part of the frame.
bool may_measure(const PilotFrame& frame, uint64_t max_paths);

// Fills in the figures of all arms, tracing by their options, with the same places of the frame for
// each. The variance of an arm is that between two paths of a pixel, with single bright paths held
// where it is said, and at least what its difference from the first arm tells: paths that are found
// once in N have at least N times their part of the mean, squared, as second moment, also while
// none has been found. Where the paths do not reach for one look of all arms over the frame, the
// last ones are dropped; false where nothing may be measured. Equal at any thread count unless
// timed or stopped.
bool measure(const PathTracer& tracer, std::vector<PilotArm>& arms, const PilotFrame& frame,
             const MethodPilotOptions& options, const std::function<bool()>& stop);

}  // namespace waylight
