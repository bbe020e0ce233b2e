#include "libguide/scene/surface.h"

#include "libguide/math/frame.h"

namespace waylight {
namespace {

using Vec3d = Eigen::Vector3d;

// Embree subtracts the origin from the corners and multiplies by a normal of its own: errors of a
// few ulps of the triangle's extent, whatever the distance to the world's origin.
float intersection_error(float extent) { return 4 * kRounding * extent; }

void set_frame_tangents(SurfacePoint& point) {
  const Frame frame(point.ng);
  point.dpdu = frame.s;
  point.dpdv = frame.t;
}

// Solves dp = dpdu du + dpdv dv for the two edges.
bool uv_tangents(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t, SurfacePoint& point) {
  if (mesh.uvs.empty()) return false;
  const Vec2 d1 = mesh.uvs[t[1]] - mesh.uvs[t[0]], d2 = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const double det = static_cast<double>(d1.x()) * d2.y() - static_cast<double>(d1.y()) * d2.x();
  const float inverse = static_cast<float>(1 / det);
  if (!std::isfinite(inverse)) return false;
  const Vec3 e1 = mesh.positions[t[1]] - mesh.positions[t[0]];
  const Vec3 e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
  point.dpdu = inverse * (d2.y() * e1 - d1.y() * e2);
  point.dpdv = inverse * (d1.x() * e2 - d2.x() * e1);
  const float length2 = point.dpdu.squaredNorm() * point.dpdv.squaredNorm();
  return std::isfinite(length2) && length2 > 0;
}

// Interpolated normal, on the side of ng; ng where it has no direction.
Vec3 shading_normal(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t, float b1, float b2,
                    const Vec3& ng) {
  if (mesh.normals.empty()) return ng;
  const Vec3 n =
      (1 - b1 - b2) * mesh.normals[t[0]] + b1 * mesh.normals[t[1]] + b2 * mesh.normals[t[2]];
  const float length = n.norm();
  if (!(length > 1e-6f)) return ng;
  const float side = n.dot(ng);
  if (std::abs(side) < 1e-6f * length) return ng;
  return n / std::copysign(length, side);
}

}  // namespace

void locate_on_triangle(const TriangleMesh& mesh, uint32_t triangle, float b1, float b2,
                        SurfacePoint& point) {
  const std::array<uint32_t, 3>& t = mesh.triangles[triangle];
  const Vec3d a = mesh.positions[t[0]].cast<double>();
  const Vec3d e1 = mesh.positions[t[1]].cast<double>() - a;
  const Vec3d e2 = mesh.positions[t[2]].cast<double>() - a;
  const Vec3d on_plane = a + b1 * e1 + b2 * e2;
  const float extent = static_cast<float>(std::max(
      {e1.cwiseAbs().maxCoeff(), e2.cwiseAbs().maxCoeff(), (e2 - e1).cwiseAbs().maxCoeff()}));
  point.p_error += position_error(on_plane) + intersection_error(extent);
  const double inwards = std::min(1.0, 2.0 * point.p_error / extent);
  point.p = (on_plane + inwards * (a + (e1 + e2) / 3 - on_plane)).cast<float>();
  point.ng = e1.cross(e2).normalized().cast<float>();
  point.uv = mesh.uvs.empty()
                 ? Vec2(b1, b2)
                 : Vec2((1 - b1 - b2) * mesh.uvs[t[0]] + b1 * mesh.uvs[t[1]] + b2 * mesh.uvs[t[2]]);
}

void shade_triangle(const TriangleMesh& mesh, uint32_t triangle, float b1, float b2,
                    SurfacePoint& point) {
  const std::array<uint32_t, 3>& t = mesh.triangles[triangle];
  point.ns = shading_normal(mesh, t, b1, b2, point.ng);
  if (!uv_tangents(mesh, t, point)) set_frame_tangents(point);
}

void locate_on_sphere(const Sphere& sphere, bool flip, const Vec3d& normal, SurfacePoint& point) {
  const Vec3d n = normal.normalized();
  const Vec3d p = sphere.center.cast<double>() + static_cast<double>(sphere.radius) * n;
  point.p = p.cast<float>();
  point.p_error += position_error(p) + kRounding * sphere.radius;
  point.ng = (flip ? Vec3d(-n) : n).cast<float>();
  const Vec3 local = sphere.frame.transpose() * n.cast<float>();
  const float phi = std::atan2(local.y(), local.x());
  point.uv = {(phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi),
              std::acos(std::clamp(local.z(), -1.0f, 1.0f)) * kInvPi};
}

// p = r (cos 2 pi u sin pi v, sin 2 pi u sin pi v, cos pi v).
void shade_sphere(const Sphere& sphere, SurfacePoint& point) {
  point.ns = point.ng;
  const Vec3 n = sphere.frame.transpose() * (point.p - sphere.center).normalized();
  const float sin_theta = std::hypot(n.x(), n.y());
  if (sin_theta < 1e-6f) return set_frame_tangents(point);
  const float cos_phi = n.x() / sin_theta, sin_phi = n.y() / sin_theta;
  const Vec3 du = 2 * kPi * sphere.radius * Vec3(-n.y(), n.x(), 0);
  const Vec3 dv = kPi * sphere.radius * Vec3(n.z() * cos_phi, n.z() * sin_phi, -sin_theta);
  point.dpdu = sphere.frame * du;
  point.dpdv = sphere.frame * dv;
}

bool intersect_sphere(const Sphere& sphere, const Vec3d& origin, const Vec3d& direction,
                      double& near, double& far) {
  const Vec3d from_center = origin - sphere.center.cast<double>();
  const double a = direction.squaredNorm();
  const double middle = -from_center.dot(direction) / a;
  const Vec3d perpendicular = from_center + middle * direction;
  const double r = sphere.radius;
  const double half2 = (r * r - perpendicular.squaredNorm()) / a;
  if (!(half2 >= 0)) return false;
  near = middle - std::sqrt(half2);
  far = middle + std::sqrt(half2);
  return true;
}

}  // namespace waylight
