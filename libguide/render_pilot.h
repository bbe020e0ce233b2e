#pragma once
// Mode auto: what pays is found out by a small render before the render.

#include <functional>

#include "libguide/guiding/guiding_caches.h"
#include "libguide/render.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

// What `--mode auto` decides on: each cell what it is sampled by, and then for the whole render
// what has the least variance times cost. It begins with everything guided and asks what becomes
// better without, or with something else: resampling, light without product, standard directions
// and distances in media, guided distances in grids. Roulette is not asked about: what it does
// wrong are rare bright paths, which a pilot does not see. What does by more than the standard
// error of the comparison is taken, all together; at last it is compared with plain path tracing.
// Only what the options leave open is asked. The choices of the cells are left in `guiding`.
PathTracerOptions choose_method(const Scene& scene, const SensorDescription& sensor,
                                const PathTracer& tracer, GuidingCaches& guiding,
                                const RenderOptions& options, const std::function<bool()>& stop,
                                AutoDecision* decision);

}  // namespace waylight
