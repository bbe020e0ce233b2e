#pragma once
// Where an instance stands: points and normals of a group's own space carried to the world.

#include "libguide/scene/surface.h"

namespace waylight {

class Placement {
 public:
  explicit Placement(const Mat4& to_world);

  static bool invertible(const Mat4& to_world);

  // The ray in the group's space, with the same parameter t.
  Eigen::Vector3d local_origin(const Ray& ray) const;
  Eigen::Vector3d local_direction(const Ray& ray) const;
  // Along each local axis, the rounding of Embree's own transform of rays that begin near p.
  float local_error(const Vec3& p) const;
  // Transforms every field of a local point whose p_error includes local_error().
  void to_world(SurfacePoint& point) const;
  Bounds to_world(const Bounds& bounds) const;

 private:
  Eigen::Matrix3d linear_, inverse_;
  Eigen::Vector3d translation_;
};

}  // namespace waylight
