#pragma once
// A small render that teaches each cell its share of BSDF sampling (guiding/bsdf_shares.h).

#include <functional>

#include "libguide/scene/scene_description.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

struct SharePilotOptions {
  uint64_t seed = 0;
  float default_share = 0.5f;
  // Paths that the render itself will trace; the pilot takes no more than a 16th of them. 0:
  // unknown.
  uint64_t render_paths = 0;
};

// tracer: one that does not split paths.
// The shares by cell; empty when the render is too short for a pilot. About 16000 pixels of the
// whole film with up to eight samples each. The contribution of a vertex is taken relative to the
// mean of the tile of pixels that it lies in, as in relMSE: sqrt(mean^2 + 0.01). Equal at any
// thread count unless `stop` ends it.
std::vector<float> learn_shares(const PathTracer& tracer, const SensorDescription& sensor,
                                size_t cells, const SharePilotOptions& options,
                                const std::function<bool()>& stop);

}  // namespace waylight
