#pragma once
// One camera path and its copies, with next-event estimation; the same loop for every mode.

#include <vector>

#include "libguide/base/sampler.h"
#include "libguide/guiding/flights.h"
#include "libguide/guiding/phase_sampler.h"
#include "libguide/scene/scene.h"
#include "libguide/transport/path_vertex.h"
#include "libguide/transport/segment_sums.h"
#include "libguide/transport/weight_window.h"

namespace waylight {

// Russian roulette. throughput: by what BSDF sampling would have made of the throughput, after
// rr_depth edges. guided: by the path's expected contribution, as caches have it, over that of its
// pixel (weight_window.h); by throughput where no cache is known, as far as it changed since the
// caches last judged the path. Mirrors and smooth glass leave the decision to the next vertex.
// Both are played after next-event estimation: what they credit is the light that is still to come,
// which is what caches hold that dropped direct photons.
enum class Roulette { none, throughput, guided };

// Bounds of splitting, whatever the caches say: copies made at one vertex, copies of one camera
// path that wait, and copies made of one camera path in all. Past the last, roulette is by
// throughput.
inline constexpr int kMaxSplit = 20, kMaxWaiting = 32, kMaxCopies = 64;

struct PathTracerOptions {
  DirectionOptions directions;
  PhaseOptions phases;
  FlightMethod flight = FlightMethod::standard;  // also where those that need guides have none
  FlightOptions flights;
  Roulette roulette = Roulette::throughput;
  WeightWindow window;         // of guided roulette
  int max_split = 1;           // copies at one vertex under guided roulette, 1 .. kMaxSplit
  int max_depth = -1;          // path edges; -1 no limit
  int rr_depth = 5;            // path edges before Russian roulette
  bool hide_emitters = false;  // emitters and environment are invisible to the camera itself
};

// A guided vertex of a path, for learning (cell_choices.h).
struct GuidedVertex {
  uint32_t cell;
  float bsdf_pdf, light_pdf, guide_pdf, pdf;
  float radiance_before;  // luminance of what the path had found when it left the vertex
};

// What is known of a path before it is traced.
struct PathContext {
  float pixel_estimate = 0;  // I, luminance; 0: as caches have it at the first vertex with one
  float filter_weight = 1;   // of the contributions to `segments`
  SegmentSums* segments = nullptr;
  std::vector<GuidedVertex>* guided =
      nullptr;  // where guided vertices are appended; without splits
};

// What one camera path found, with all its copies.
struct PathRecord {
  Color radiance = Color::Zero();
  Color albedo = Color::Zero();
  Vec3 normal = Vec3::Zero();
  float depth = 0;           // distance to the first vertex; 0 when there is none
  uint32_t edges = 0;        // vertices that the path scattered at, plus one
  uint32_t killed = 0;       // times that roulette ended it
  uint32_t copies = 0;       // that splitting added
  uint32_t scatterings = 0;  // smooth ones
  uint32_t guided = 0;       // smooth ones that had a guide
  uint32_t in_grids = 0;     // smooth ones, in heterogeneous media
  float bsdf_share = 0;      // sum of the shares of BSDF sampling at smooth ones
  uint32_t rays = 0;
  uint32_t guided_flights = 0;  // through media, by other than the standard method

  // It turned out to be a pane that the path goes straight through.
  void forget_first_vertex() { albedo = Color::Zero(), normal = Vec3::Zero(), depth = 0; }
};

class PathTracer {
 public:
  // camera_medium: the one that camera rays start in.
  PathTracer(const Scene& scene, const GuidingCaches& caches, const PathTracerOptions& options,
             int camera_medium = kNone)
      : scene_(scene), caches_(caches), options_(options), camera_medium_(camera_medium) {
    options_.directions.estimates = options.roulette == Roulette::guided;
  }

  // The same scene and caches by other options.
  PathTracer with(const PathTracerOptions& options) const {
    return {scene_, caches_, options, camera_medium_};
  }

  PathRecord trace(const Ray& ray, const Sampler& sampler, const PathContext& context = {}) const;
  // An unbiased estimate of the fluence at a point of a medium, W/m^2: next-event estimation from
  // there, and a path in a direction that is uniform over the sphere. max_depth counts edges from
  // the point.
  PathRecord gather(const Vec3& p, int medium, const Sampler& sampler,
                    const PathContext& context = {}) const;

 private:
  struct State;
  struct Walk;
  PathRecord follow(Walk& walk, State& state) const;
  bool advance(Walk& walk, State& state) const;
  PathVertex next_vertex(Walk& walk, State& state) const;
  std::optional<MediumPoint> fly(Walk& walk, State& state, float t_max, float crossed) const;
  Flight flight(Walk& walk, State& state, const MediumTracker& medium, float t_max) const;
  bool visit(Walk& walk, State& state, const SurfacePoint& at) const;
  bool visit(Walk& walk, State& state, const MediumPoint& at) const;
  bool too_deep(const State& state) const;
  void add_emission(Walk& walk, const State& state, const SurfacePoint& at) const;
  void add_emission(Walk& walk, State& state, const MediumTracker& medium, float t_max) const;
  void add_environment(Walk& walk, const State& state) const;

  // At: SurfacePoint with Directions a DirectionSampler, or MediumPoint with a PhaseSampler.
  template <typename At, typename Directions>
  bool go_on(Walk& walk, State& state, const At& at, const Directions& directions) const;
  template <typename At, typename Directions>
  void add_direct_light(Walk& walk, State& state, const At& at, const Directions& directions) const;
  template <typename Directions>
  int choose_copies(Walk& walk, State& state, const Directions& directions) const;
  template <typename At, typename Directions>
  bool scatter_copies(Walk& walk, State& state, int copies, const At& at,
                      const Directions& directions) const;
  template <typename At, typename Directions>
  bool scatter(Walk& walk, State& state, const At& at, const Directions& directions) const;
  template <typename At>
  bool pass_pane(Walk& walk, State& state, const At& at, const DirectionSample& through) const;
  bool survives_throughput(State& state) const;

  const Scene& scene_;
  const GuidingCaches& caches_;
  PathTracerOptions options_;
  int camera_medium_;
};

}  // namespace waylight
