#pragma once
// All emitters of a scene and the choice among them.

#include <variant>

#include "libguide/scene/area_emitter.h"
#include "libguide/scene/delta_emitter.h"
#include "libguide/scene/distant_emitter.h"

namespace waylight {

using Emitter = std::variant<MeshEmitter, SphereEmitter, PointEmitter, SpotEmitter,
                             DirectionalEmitter, ConstantEmitter, MapEmitter, DiskEmitter>;

// For next-event estimation an emitter is chosen half uniformly, half by power, so that neither a
// weak lamp close by nor a strong one far away is neglected; for emission by power alone. Emitters
// without power are never chosen. Distant emitters with extent overlap in direction: a sample of
// one carries the radiance and the density of them all.
class LightSet {
 public:
  LightSet() = default;
  // Keeps pointers into the description.
  LightSet(const SceneDescription& scene, const SceneSphere& sphere);

  bool empty() const { return chosen_.empty(); }
  double power() const { return empty() ? 0 : by_power_.total(); }  // W, mean of the channels
  bool has_distant() const;  // with power, directional ones included
  Color environment(const Vec3& direction) const;
  float environment_pdf(const Vec3& direction) const;
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  float pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
  // As if the emitter were the only one.
  std::optional<EmissionSample> emit(int emitter, float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
  float emission_prob(int emitter) const {
    return by_power_.empty() ? 0.0f : by_power_.prob(emitter);
  }

 private:
  std::vector<Emitter> emitters_;
  std::vector<int> distant_;  // those with extent
  Discrete chosen_;           // by half uniform, half power
  Discrete by_power_;
};

}  // namespace waylight
