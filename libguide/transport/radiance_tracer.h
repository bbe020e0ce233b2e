#pragma once
// One path from the camera that carries the radiance that it finds back to its vertices.

#include <optional>
#include <vector>

#include "libguide/base/sampler.h"
#include "libguide/guiding/phase_sampler.h"
#include "libguide/records/photon.h"
#include "libguide/scene/scene.h"
#include "libguide/transport/camera_start.h"
#include "libguide/transport/path_vertex.h"

namespace waylight {

struct RadianceTracerOptions {
  int max_depth = 64;  // scattering events
  int rr_depth = 4;    // scattering events before Russian roulette, by the albedo
};

// A scattering event of a path, or its start at the camera, and the light that arrives there from
// where the path went on.
struct RadianceStep {
  Vec3 position, normal, wi;
  bool stores = false;              // a sample: at surfaces, in a direction with a density
  bool both_sides = false;          // light scatters here from the other side as well
  float cos_over_pdf = 0;           // |cos wi| / p(wi), sr
  Color weight = Color::Ones();     // of what arrives, to what leaves towards the camera
  Color edge = Color::Ones();       // of what leaves the next step, to what arrives here
  Color direct = Color::Zero();     // radiance straight from emitters, MIS-weighted
  Color scattered = Color::Zero();  // radiance by next-event estimation at its end, and of media
  Vec3 to_light;                    // of next-event estimation at this vertex
  Color light = Color::Zero();      // its estimate of the direct irradiance, MIS-weighted
};

// The steps of one path, from the camera on; kept between paths for its memory.
using RadiancePath = std::vector<RadianceStep>;

// What a vertex says of indirect light is what leaves the vertices beyond it: their next-event
// estimation, light met behind mirrors, and what they scatter in turn. Emitters that it meets
// itself and its own next-event estimation are its direct light. Directions are those of
// SpreadDirections, so no sample is large because its density is small. Paths scatter in media and
// leave nothing there.
class RadianceTracer {
 public:
  // cache: empty, or of this scene's radiance; guides the paths. It must outlive this.
  RadianceTracer(const Scene& scene, const RadianceTracerOptions& options,
                 const GuideCacheView& cache = {});

  // Appends the samples of one path.
  void trace(Sampler& sampler, RadiancePath& path, PhotonRecords* records) const;

 private:
  struct State;
  PathVertex next_vertex(State& state) const;
  std::optional<MediumPoint> fly(State& state, float t_max, float crossed) const;
  bool visit(State& state, const SurfacePoint& at) const;
  bool visit(State& state, const MediumPoint& at) const;
  bool survives(State& state, float albedo, RadianceStep& step) const;
  bool pass_pane(State& state, const SurfacePoint& at, const Color& weight) const;
  void set_sample(RadianceStep& step, const SurfacePoint& at, const Vec3& wo,
                  const std::optional<DirectionSample>& next, float smooth_prob) const;
  template <typename At>
  bool go_on(State& state, const At& at, const DirectionSample& next, RadianceStep& step) const;
  void meet_emitter(State& state, const SurfacePoint& at) const;
  void meet_environment(State& state) const;
  template <typename At, typename Directions>
  void add_direct_light(State& state, const At& at, const Directions& directions,
                        RadianceStep& step) const;

  const Scene& scene_;
  RadianceTracerOptions options_;
  CameraStart camera_;
  GuidingCaches caches_;
  DirectionOptions directions_;
};

}  // namespace waylight
