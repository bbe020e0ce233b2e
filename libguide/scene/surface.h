#pragma once
// From a primitive and its coordinates to a SurfacePoint, with a bound on the rounding error.

#include "libguide/scene/scene.h"

namespace waylight {

// Half an ulp: a float x is off by at most kRounding |x|.
inline constexpr float kRounding = 0x1p-24f;

// Rounding of a point and of the origin offset from it, half an ulp each, with a margin.
inline float position_error(const Eigen::Vector3d& p) {
  return 2.5f * kRounding * static_cast<float>(p.cwiseAbs().maxCoeff());
}

// p, ng, uv and p_error of the point a + b1 (b - a) + b2 (c - a); enough for a light sample. The
// point is moved towards the centroid by as much as its error, so that no rounding can put it on or
// behind a neighbour that meets the triangle at an edge. p_error of `point` goes in as what else
// will be rounded: 0, or that of an instance's transform.
void locate_on_triangle(const TriangleMesh& mesh, uint32_t triangle, float b1, float b2,
                        SurfacePoint& point);
// ns, dpdu, dpdv beside them.
void shade_triangle(const TriangleMesh& mesh, uint32_t triangle, float b1, float b2,
                    SurfacePoint& point);

// `normal`: from the centre to the point, any length, outward. p_error as above.
void locate_on_sphere(const Sphere& sphere, bool flip, const Eigen::Vector3d& normal,
                      SurfacePoint& point);
void shade_sphere(const Sphere& sphere, SurfacePoint& point);

// Where a line meets a sphere: distances along `direction` (any length), near before far, in double
// precision and without cancellation; false when it misses.
bool intersect_sphere(const Sphere& sphere, const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction, double& near, double& far);

// Origin of a ray that leaves the point to the side of `direction`: off the plane by p_error along
// each axis, which no rounding in the point, the sum or Embree's test can undo. The idea is that of
// [Waechter, Binder 2019]; their constants are for unknown errors and would cost a scene that lies
// 1e5 from the origin some metres.
inline Vec3 offset_origin(const RayOrigin& point, const Vec3& direction) {
  const float distance = point.p_error * point.ng.lpNorm<1>();
  return point.p + (direction.dot(point.ng) < 0 ? -distance : distance) * point.ng;
}

}  // namespace waylight
