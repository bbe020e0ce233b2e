#pragma once
// The scene as the integrators see it. Embree and the emitters live behind this.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libguide/bsdf/bsdf.h"
#include "libguide/medium/medium_tracker.h"
#include "libguide/scene/scene_description.h"

namespace waylight {

// Transparent surfaces in a row before a ray is given up.
inline constexpr int kMaxCrossings = 1000;

// Where rays begin: a point of a medium as it is, or of a surface.
struct RayOrigin {
  Vec3 p = Vec3::Zero();
  // Unit; on the emitting side of an area light. Where a mesh has vertex normals these decide the
  // side, not the winding (as in Mitsuba).
  Vec3 ng = Vec3::Zero();
  float p_error = 0;  // along each axis: how far from p a new ray must begin to clear the surface
};

// A point on a surface, in world space.
struct SurfacePoint : RayOrigin {
  float t = 0;
  Vec3 ns;  // unit, on the side of ng
  Vec3 dpdu, dpdv;
  Vec2 uv;
  int material = kNone, emitter = kNone;  // no material: a black absorber
  int interior_medium = kNone, exterior_medium = kNone;
  uint32_t shape = 0;  // index into SceneDescription::shapes (or group_shapes when instanced)
};

// The medium that a ray is in once it has left a surface towards `direction`: the one that the
// surface names on that side, or none; `current` where it names none on either side. So of media
// that overlap, the boundary crossed last decides, as in Mitsuba.
inline int medium_beyond(const SurfacePoint& at, const Vec3& direction, int current) {
  if (at.interior_medium == kNone && at.exterior_medium == kNone) return current;
  return at.ng.dot(direction) < 0 ? at.interior_medium : at.exterior_medium;
}

// A direction to a light as seen from a point. radiance is before visibility; for a delta light
// (point, spot, directional) it is the incident irradiance on a plane facing it.
struct LightSample {
  Vec3 wi;
  float distance = kInfinity;
  Color radiance;
  float pdf = 0;  // per steradian, selection of the light included; delta: its probability
  bool is_delta = false;
};

// A particle leaving an emitter, power = Le cos / pdf of everything chosen (W).
struct EmissionSample {
  Ray ray;
  Color power;
  int emitter = kNone;
};

class Scene {
 public:
  // Prepares and keeps the description: degenerate triangles are left out, normals normalised,
  // flips applied. Throws Error where its parts do not fit together.
  explicit Scene(SceneDescription description);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  const SceneDescription& description() const { return description_; }
  const Bounds& bounds() const { return bounds_; }
  // What was repaired or left out, one sentence per kind and shape; empty for a clean scene.
  const std::vector<std::string>& build_warnings() const;

  // Nearest surface along the ray, transparent ones included.
  std::optional<SurfacePoint> intersect(const Ray& ray) const;

  // Origin moved off the surface by its error bound, to the side of `direction`.
  Ray spawn_ray(const RayOrigin& from, const Vec3& direction) const;
  // Share of light that passes from a point along wi over `distance` (infinite allowed): the
  // product of 1 - opacity, and of what panes transmit, over the surfaces between; 0 when blocked.
  // The last 1e-4 of a finite distance are not looked at, so that the light does not block itself.
  // Beyond 1000 transparent surfaces it is 0.
  Color visibility(const RayOrigin& from, const Vec3& wi, float distance) const;
  // The same with the transmittance of media, an unbiased estimate. medium: the one that the ray
  // starts in. Draws from `path` only where there are media.
  Color transmittance(const RayOrigin& from, int medium, const Vec3& wi, float distance,
                      Sampler& path) const;

  bool has_media() const { return !media_.empty(); }
  const MediumTracker& medium(int index) const { return media_[index]; }
  // The medium around a point that is on no surface, told by the first boundary in some direction.
  int medium_at(const Vec3& p) const;

  ResolvedBsdf bsdf(const SurfacePoint& at, const Vec3& wo, TransportMode mode) const;
  float opacity(const SurfacePoint& at) const;
  bool may_be_transparent(const SurfacePoint& at) const;  // or pass light straight on

  // Radiance that an area light's surface sends towards wo; zero off the emitting side.
  Color emitted(const SurfacePoint& at, const Vec3& wo) const;
  // Radiance of all distant emitters with extent along a ray that leaves the scene.
  Color environment(const Vec3& direction) const;

  // One emitter, chosen half uniformly and half by power, and a direction to it. Distant emitters
  // with extent overlap: a sample of one carries environment() and environment_pdf(), the sums over
  // them all, so that whichever was chosen the estimate is the same.
  std::optional<LightSample> sample_light(const Vec3& from, float u, const Vec2& u2) const;
  // Density with which sample_light(from) makes the direction towards this point of an area light.
  float light_pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const;
  // The same for directions that leave the scene.
  float environment_pdf(const Vec3& wi) const;

  // Emitter by power, position by area, direction by cosine or by radiance; distant light enters
  // over the cross section of the sphere around the scene.
  std::optional<EmissionSample> sample_emission(float u, const Vec2& u_position,
                                                const Vec2& u_direction) const;
  // The same of one emitter, as if it were the only one, and the probability with which
  // sample_emission() chooses it.
  std::optional<EmissionSample> emit(int emitter, float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
  float emission_prob(int emitter) const;
  double emitter_power() const;    // W, mean of the colour channels; of media none
  bool has_lights() const;         // some emitter has power, or some medium emits
  bool has_distant_light() const;  // and some that has is not within the scene's bounds
  bool has_environment() const;    // some ray that leaves the scene meets light

 private:
  Color straight_transmission(const SurfacePoint& at, const Vec3& direction) const;
  Color pass(const RayOrigin& from, int medium, const Vec3& wi, float distance,
             RandomStream* random) const;

  struct Impl;  // Embree's handles and the emitters' tables
  SceneDescription description_;
  Bounds bounds_;
  std::vector<MediumTracker> media_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace waylight
