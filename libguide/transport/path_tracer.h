#pragma once
// One camera path with next-event estimation; the same loop for every mode.

#include "libguide/base/sampler.h"
#include "libguide/guiding/direction_sampler.h"
#include "libguide/scene/scene.h"

namespace waylight {

// Russian roulette. throughput: by what BSDF sampling would have made of the throughput, after
// rr_depth edges. guided: by the path's expected contribution, as caches have it, over that of its
// first vertex with a cache [Vorba, Krivanek 2016]; by throughput where no cache is known.
enum class Roulette { none, throughput, guided };

struct PathTracerOptions {
  DirectionGuide guide = DirectionGuide::none;
  float guiding_prob = 0.5f;
  Roulette roulette = Roulette::throughput;
  int max_depth = -1;          // path edges; -1 no limit
  int rr_depth = 5;            // path edges before Russian roulette
  bool hide_emitters = false;  // emitters and environment are invisible to the camera itself
};

// What one path found besides its radiance.
struct PathRecord {
  Color radiance = Color::Zero();
  Color albedo = Color::Zero();
  Vec3 normal = Vec3::Zero();
  float depth = 0;           // distance to the first surface; 0 when there is none
  uint32_t edges = 0;        // surfaces that the path scattered at, plus one
  uint32_t scatterings = 0;  // smooth ones
  uint32_t guided = 0;       // smooth ones that had a guide
  uint32_t rays = 0;
};

class PathTracer {
 public:
  PathTracer(const Scene& scene, const GuidingCaches& caches, const PathTracerOptions& options)
      : scene_(scene), caches_(caches), options_(options) {}

  PathRecord trace(Ray ray, Sampler& sampler) const;

 private:
  struct State;
  bool advance(State& state, Sampler& sampler) const;
  std::optional<SurfacePoint> next_surface(State& state, Sampler& sampler) const;
  void add_emission(State& state, const SurfacePoint& at) const;
  void add_environment(State& state) const;
  void add_direct_light(State& state, const SurfacePoint& at, const DirectionSampler& directions,
                        Sampler& sampler) const;
  static bool play(State& state, float survival_prob, Sampler& sampler);
  bool survives_guided(State& state, const DirectionSampler& directions, Sampler& sampler) const;
  bool survives_throughput(State& state, Sampler& sampler) const;

  const Scene& scene_;
  const GuidingCaches& caches_;
  PathTracerOptions options_;
};

}  // namespace waylight
