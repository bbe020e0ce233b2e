#pragma once
// Mode auto: what pays is found out by a small render before the render.

#include <functional>

#include "libguide/guiding/guiding_caches.h"
#include "libguide/render.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

// What `--mode auto` decides on: each cell what it is sampled by, and then for the whole render
// what has the least variance times cost. It begins with everything guided and asks what
// becomes better without, or with something else: resampling, light without product, standard
// directions and distances in media, guided distances in grids, roulette by throughput, or
// guided where most scatterings are in grids: there it begins by throughput. What does by three
// standard errors of the comparison, and a tenth where it guides less (three tenths where it
// leaves surfaces beside media to their BSDFs), is taken, the best of each decision, all together;
// at last comes plain path tracing, if it is better than any of these, unless the comparison is
// known to worse than a third; or wherever it is not surely worse, if hardly a scattering has a
// guide or the cells are few, and not four times worse, if it has little noise. A render too small
// to compare guides everything, or nothing for the same reasons, as far as a few paths tell them.
// Only what the options leave open is asked. The choices of the cells are left in `guiding`, and
// the fits only if a cell uses them: they are loaded for surfaces that have cells, and not where it
// is known before that guiding hardly pays.
PathTracerOptions choose_method(const Scene& scene, const SensorDescription& sensor,
                                const PathTracer& tracer, GuidingCaches& guiding,
                                const RenderOptions& options, const std::function<bool()>& stop,
                                AutoDecision* decision);

}  // namespace waylight
