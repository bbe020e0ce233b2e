#pragma once
// The scene as the integrators see it. Embree and the emitters live behind this.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libguide/bsdf/bsdf.h"
#include "libguide/scene/scene_description.h"

namespace waylight {

// A point on a surface, in world space.
struct SurfacePoint {
  float t = 0;
  Vec3 p;
  // Unit; ng on the emitting side of an area light, ns on the side of ng. Where a mesh has vertex
  // normals these decide the side, not the winding (as in Mitsuba).
  Vec3 ng, ns;
  Vec3 dpdu, dpdv;
  Vec2 uv;
  int material = kNone, emitter = kNone;  // no material: a black absorber
  int interior_medium = kNone, exterior_medium = kNone;
  uint32_t shape = 0;  // index into SceneDescription::shapes (or group_shapes when instanced)
  float p_error = 0;   // along each axis: how far from p a new ray must begin to clear the surface
};

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
  Ray spawn_ray(const SurfacePoint& from, const Vec3& direction) const;
  // Share of light that passes from the surface point along wi over `distance` (infinite allowed):
  // the product of 1 - opacity over the surfaces between; 0 when blocked. The last 1e-4 of a finite
  // distance are not looked at, so that the light does not block itself. Beyond 1000 transparent
  // surfaces it is 0.
  float visibility(const SurfacePoint& from, const Vec3& wi, float distance) const;

  ResolvedBsdf bsdf(const SurfacePoint& at, const Vec3& wo, TransportMode mode) const;
  float opacity(const SurfacePoint& at) const;

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
  bool has_lights() const;         // some emitter has power
  bool has_distant_light() const;  // and some that has is not within the scene's bounds

 private:
  struct Impl;  // Embree's handles and the emitters' tables
  SceneDescription description_;
  Bounds bounds_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace waylight
