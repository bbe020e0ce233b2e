#pragma once
// Stage: path tracing with next-event estimation and MIS; directions by BSDF, illumination guiding
// [Vorba et al. 2014], product guiding [Herholz et al. 2016], or resampling [Talbot et al. 2005].

#include <functional>
#include <optional>
#include <vector>

#include "libguide/base/run_control.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/image/image.h"
#include "libguide/records/aov_set.h"
#include "libguide/records/brdf_cache.h"
#include "libguide/records/fluence_slice.h"
#include "libguide/records/method_figures.h"
#include "libguide/scene/scene.h"
#include "libguide/transport/segment_sums.h"

namespace waylight {

// automatic: what a pilot finds to pay, of what the caches that are given make possible
// (render_pilot.h).
enum class RenderMode { bsdf, illumination, mixture, product, ris, automatic };

inline bool needs_fits(RenderMode mode) {
  return mode == RenderMode::product || mode == RenderMode::mixture;
}

// What part of the directions is left to BSDF sampling where there is a guide. learned: per cell,
// by a small render before (transport/choice_pilot.h). automatic: learned in mode illumination,
// whose guide knows nothing of the BSDF; 0.3 in product and mixture, where learning cost more time
// than it gained on two measured interiors; one half in ris.
enum class ShareRule { automatic, fixed, learned };

// The decisions in media [Herholz et al. 2019]: where along a ray a path scatters, and in what
// direction. automatic: guided, directions by the product, in all modes but bsdf where the cache
// holds media; distances in homogeneous media alone, since in a cloud of grid cells guiding them
// halved the variance of a sample at four times its cost. The other distances are there to be
// compared with (guiding/flights.h): the guide decides whether a path scatters only; near lights,
// in homogeneous media; by a multiple of the extinction.
enum class DistanceMode { automatic, standard, guided, probability, equiangular, exponential };
enum class PhaseMode { automatic, standard, mixture, product };

// automatic: guided where the mode has a cache, by throughput in mode bsdf.
enum class RouletteMode { automatic, none, throughput, guided };

// What guided roulette and splitting compare a path with: the caches at its own first vertex that
// has one, or a filtered preview of the image.
enum class PixelEstimateMode { cache, preview };

struct RenderOptions {
  RenderMode mode = RenderMode::bsdf;
  // The render stops at whichever comes first; at least one must be set.
  int spp = 0;      // samples per pixel, 0: no limit
  double time = 0;  // seconds of rendering, 0: no limit
  // Seconds are processor seconds over threads, for measuring on a machine that others use.
  bool cpu_clock = false;
  float error = 0;  // relMSE estimated from the image's own variance, 0: no limit
  // Seconds of rendering, rising, at which the image so far is handed out; ends nothing.
  std::vector<double> checkpoints;
  uint64_t seed = 0;
  int width = 0, height = 0;  // 0: the scene's; cropped scenes keep their window in proportion
  int crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0;  // pixels; crop_width 0: scene's
  int max_depth = -2;  // path edges; -1 no limit, -2 the scene's
  int rr_depth = -1;   // path edges before Russian roulette; -1 the scene's
  DistanceMode distance = DistanceMode::automatic;
  float distance_bias = 0.5f;  // of distance `exponential`: factor of the extinction, (0, 10]
  PhaseMode direction = PhaseMode::automatic;
  RouletteMode roulette = RouletteMode::automatic;
  float weight_window = 5;  // of guided roulette, ratio of its ends (weight_window.h), 1 .. 1000
  // Copies that guided roulette may make of a path at one vertex, 1 .. 20; 0: 2 in mode automatic,
  // which is about as fast to the same error but for fireflies, which it takes away; else 1.
  int split = 0;
  PixelEstimateMode pixel_estimate = PixelEstimateMode::cache;
  bool segments = false;  // sum contributions by the number of edges
  ShareRule share_rule = ShareRule::automatic;
  float bsdf_share = 0.5f;  // of rule `fixed`, 0.01..1
  int candidates = 2;       // of mode ris, 1..64
  AovSet aovs;
  // The fluence in media over a plane, in place of what the camera sees.
  std::optional<FluenceSlice> fluence;
  // The radiance that arrives at a point from everywhere (sphere_view.h), in place of it.
  std::optional<Vec3> sphere;

  void validate() const;
};

// What guides. `guide` may be empty unless needs_cache(), `brdf` is needed in modes product and
// mixture only; mode automatic uses both where they are given, and asks for the fits where it may
// use them (render_pilot.h).
struct RenderCaches {
  BrdfSource brdf;
  GuideCacheView guide;
};

struct RenderSummary {
  int width = 0, height = 0;  // of the image
  double mean_spp = 0;
  double seconds = 0;            // rendering alone, the preview included, by RenderOptions' clock
  double cpu_seconds = 0;        // of all threads of the process meanwhile
  double preview_seconds = 0;    // of them
  uint64_t rays = 0;             // camera, scattered and shadow rays, those of the preview included
  double mean_path_length = 0;   // edges per camera path, those of its copies included
  double killed_share = 0;       // paths ended by roulette, per path: camera paths and copies
  double copies_per_path = 0;    // made by splitting, per camera path
  double bsdf_share = 1;         // of BSDF sampling in smooth scattering, mean over all of it
  double guiding_share = 0;      // share of smooth scattering events that had a guide
  double estimated_relmse = 0;   // of the image, from its own variance
  uint64_t invalid_samples = 0;  // NaN or infinite, counted as zero
  bool interrupted = false;
  SegmentSums segments;   // with options.segments only
  AutoDecision decision;  // of mode automatic
};

// Gets the image and its figures when a checkpoint is reached, or, where the render ends before,
// then; none after an interrupt. Its time is not the render's.
using CheckpointSink = std::function<void(double checkpoint, const Image&, const RenderSummary&)>;

// Channels R, G, B and those of `aovs`. The same bytes for equal inputs at any thread count, unless
// `time` is given.
Image render(const Scene& scene, const RenderCaches& caches, const RenderOptions& options,
             RenderSummary* summary, const RunControl& control,
             const CheckpointSink& on_checkpoint = {});

}  // namespace waylight
