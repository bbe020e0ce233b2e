#pragma once
// Surfaces that emit on the side of ng, with constant radiance over directions.

#include "libguide/math/distribution.h"
#include "libguide/scene/emitter.h"

namespace waylight {

// Points uniform by area.
class MeshEmitter {
 public:
  MeshEmitter(const TriangleMesh& mesh, const Texture& radiance);

  double power() const { return power_; }
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  float pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;

 private:
  const TriangleMesh* mesh_;
  const Texture* radiance_;
  Discrete triangles_;
  float area_;
  double power_;

  SurfacePoint point(float u, const Vec2& u2) const;
};

// From outside, directions uniform over the cone in which the sphere is seen; from inside, points
// uniform by area.
class SphereEmitter {
 public:
  SphereEmitter(const Sphere& sphere, bool flip, const Texture& radiance);

  double power() const { return power_; }
  std::optional<LightSample> sample(const Vec3& from, float u, const Vec2& u2) const;
  float pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const;
  std::optional<EmissionSample> emit(float u, const Vec2& u_position,
                                     const Vec2& u_direction) const;

 private:
  const Sphere* sphere_;
  const Texture* radiance_;
  bool flip_;
  float area_;
  double power_;

  std::optional<float> cone_height(const Vec3& from) const;
  LightSample sample_cone(const Vec3& from, float height, const Vec2& u2) const;
};

}  // namespace waylight
