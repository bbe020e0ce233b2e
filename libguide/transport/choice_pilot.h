#pragma once
// A small render that teaches each cell what to sample it by (guiding/cell_choices.h).

#include <functional>

#include "libguide/transport/path_tracer.h"
#include "libguide/transport/pilot_frame.h"

namespace waylight {

struct ChoicePilotOptions {
  // Of the guides to choose from, of which the last is the one that the tracer samples by.
  std::vector<DirectionGuide> guides;
  float default_share = 0.5f;
  bool priced = false;     // the time that guides take counts
  uint64_t max_paths = 0;  // in all
};

// tracer: one that does not split paths, and tells light_pdf where it has to. The choices by cell;
// empty when too few paths may be traced. Up to eight paths per place. The
// contribution of a vertex is taken relative to the mean of the tile of places that it lies in, as
// in relMSE: over sqrt(mean^2 + 0.01),
// and is held to 32. Equal at any thread count unless `stop` ends it.
std::vector<CellChoice> learn_choices(const PathTracer& tracer, const PilotFrame& frame,
                                      size_t cells, const ChoicePilotOptions& options,
                                      const std::function<bool()>& stop);

}  // namespace waylight
