#pragma once
// What the options of a render mean to its film and its path tracer.

#include "libguide/base/stopwatch.h"
#include "libguide/render.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {

inline constexpr int kRenderTile = 16;  // pixels along a side

// The scene's film with the options' size and crop window. Throws Error where the window leaves the
// film, or memory would not do.
FilmDescription film_of(const FilmDescription& scene_film, const RenderOptions& options);

// Of BSDF sampling where nothing was learned. Incident light alone knows nothing of the BSDF; of
// the product 0.3 is the best of 0.1 .. 0.7 in two measured interiors.
float default_share(RenderMode mode);

// Started now, by the clock that the options name.
Stopwatch clock_of(const RenderOptions& options);

// What `automatic` stands for.
Roulette roulette_of(const RenderOptions& options);

// Whether a decision in media is guided where the cache holds media, and whether that is asked for
// by name; whether the render reads a cache at all.
bool guides_media(const RenderOptions& options);
bool insists_on_media(const RenderOptions& options);
bool needs_cache(const RenderOptions& options);

// Whether a pilot learns the share of each cell.
bool learns_shares(const RenderOptions& options);

// The scene's own depths where the options leave them open.
PathTracerOptions tracer_options(const Scene& scene, const RenderOptions& options);

}  // namespace waylight
