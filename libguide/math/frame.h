#pragma once
// Orthonormal frames: local z is the normal.

#include "libguide/math/types.h"

namespace waylight {

struct Frame {
  Vec3 s = Vec3::UnitX(), t = Vec3::UnitY(), n = Vec3::UnitZ();

  Frame() = default;
  Frame(const Vec3& s_axis, const Vec3& t_axis, const Vec3& normal)
      : s(s_axis), t(t_axis), n(normal) {}

  // The frame of a unit normal alone; a deterministic, branchless function of it
  // [Duff et al. 2017, Building an Orthonormal Basis, Revisited].
  explicit Frame(const Vec3& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z());
    const float a = -1.0f / (sign + n.z());
    const float b = n.x() * n.y() * a;
    s = Vec3(1.0f + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
    t = Vec3(b, sign + n.y() * n.y() * a, -n.y());
  }

  // The frame of a unit normal whose s axis is the tangent made orthogonal to it; falls back to
  // Frame(normal) when the tangent is parallel to the normal or not finite.
  static Frame from_tangent(const Vec3& normal, const Vec3& tangent) {
    const Vec3 projected = tangent - normal * normal.dot(tangent);
    const float length = projected.norm();
    if (!(length > 1e-12f) || !std::isfinite(length)) return Frame(normal);
    const Vec3 s_axis = projected / length;
    return Frame(s_axis, normal.cross(s_axis), normal);
  }

  Vec3 to_local(const Vec3& w) const { return {w.dot(s), w.dot(t), w.dot(n)}; }
  Vec3 to_world(const Vec3& v) const { return s * v.x() + t * v.y() + n * v.z(); }
};

}  // namespace waylight
