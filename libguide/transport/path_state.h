#pragma once
// What a path is while it is traced; for path_tracer.cpp alone.

#include <memory>

#include "libguide/transport/path_tracer.h"

namespace waylight {

// One of the copies of a camera path.
struct PathTracer::State {
  Ray ray;
  Sampler sampler;
  Color throughput;
  Color roulette_throughput;  // what BSDF sampling would have had since roulette by the caches
  Vec3 previous;              // last vertex, from which light_pdf is measured
  float pdf;                  // of the direction of `ray`
  bool specular;              // it came from a delta lobe or the camera
  int unjudged;               // delta scatterings since roulette went by the caches
  int edges;
  int medium;         // that `ray` is in, or kNone
  float crossed = 0;  // distance from the last vertex to the pane that `ray` leaves

  void weigh(const Color& factor) {
    throughput *= factor;
    roulette_throughput *= factor;
  }
  // Roulette by the caches has accounted for all that was before.
  void judged() {
    unjudged = 0;
    roulette_throughput = Color::Ones();
  }
};

// A camera path and all its copies, depth first. The copies that wait are not initialised before
// they are made.
struct PathTracer::Walk {
  PathRecord record;
  PathContext context;
  float pixel_estimate;  // I; 0 as long as it is not known
  int waiting_count = 0;
  union {
    std::array<State, kMaxWaiting> waiting;
  };

  explicit Walk(const PathContext& c)
      : context(c), pixel_estimate(std::isfinite(c.pixel_estimate) ? c.pixel_estimate : 0) {}

  // Copies that a vertex may be split into.
  int room(int max_split) const {
    return std::min({max_split, kMaxWaiting - waiting_count + 1,
                     kMaxCopies - static_cast<int>(record.copies) + 1});
  }
  void add(int edges, const Color& radiance) {
    record.radiance += radiance;
    if (context.segments) context.segments->add(edges, context.filter_weight * luminance(radiance));
  }
  void reach(int edges) {
    ++record.edges;
    if (context.segments) context.segments->reach(edges);
  }
};

}  // namespace waylight
