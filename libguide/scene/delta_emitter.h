#pragma once
// Emitters that no BSDF sample can meet. Their LightSample carries irradiance on a plane facing
// them.

#include "libguide/scene/emitter.h"

namespace waylight {

struct PointEmitter {
  PointLight light;

  double power() const { return 4 * kPi * mean(light.intensity); }
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
};

struct SpotEmitter {
  SpotLight light;

  // 1 within beam_width, 0 beyond cutoff, linear in the angle between (Mitsuba's).
  float falloff(float cos_angle) const;
  double power() const;
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
};

struct DirectionalEmitter {
  DirectionalLight light;
  SceneSphere sphere;

  double power() const { return sphere.cross_section() * mean(light.irradiance); }
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;
};

// A ray that enters the scene along `direction`, uniform over the cross section of its sphere.
Ray enter_scene(const SceneSphere& sphere, const Vec3& direction, const Vec2& u_position);

}  // namespace waylight
