#pragma once
// What mode auto compares: changes to what guides everything.

#include <vector>

#include "libguide/guiding/guiding_caches.h"
#include "libguide/render.h"
#include "libguide/transport/method_pilot.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

enum class Decision { surfaces, directions, distances, roulette };

// A change to what guides everything; no more than one is made of each decision.
struct Alternative {
  const char* name;
  Decision of;
  void (*apply)(PathTracerOptions&);
  bool held = true;  // not where it guides less: see PilotArm
};

// What the options leave open, and the caches make possible, to change in `everything`, by what the
// cells have learned. A short pilot gets to the first of these only.
std::vector<Alternative> alternatives(const Scene& scene, const GuidingCaches& caches,
                                      const RenderOptions& options,
                                      const PathTracerOptions& everything,
                                      const AutoDecision& cells);

// Whether a cell is sampled by the product, or may be as none has learned.
bool may_use_product(const AutoDecision& cells);

PilotArm arm_of(const Alternative& change, PathTracerOptions options);

// Nothing guided but what the options ask for by name.
PathTracerOptions plain(const RenderOptions& options, PathTracerOptions tracing);

}  // namespace waylight
