#pragma once
// Warps of uniform points to distributions over disks, hemispheres and spheres.
// Each is a forward map and its pdf, with the inverse where it is needed. Densities over directions are per steradian.

#include "libguide/math/types.h"

namespace waylight {

// Concentric map of the unit square onto the unit disk, equal-area [Shirley, Chiu 1997].
Vec2 square_to_disk(const Vec2& u);
Vec2 disk_to_square(const Vec2& p);

inline Vec3 square_to_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = square_to_disk(u);
  return {d.x(), d.y(), safe_sqrt(1 - d.squaredNorm())};
}
inline float cosine_hemisphere_pdf(const Vec3& w) { return std::max(w.z(), 0.0f) * kInvPi; }

Vec3 square_to_sphere(const Vec2& u);
inline constexpr float kSpherePdf = 0.25f * kInvPi;
Vec2 sphere_to_square(const Vec3& w);

// Lambert azimuthal equal-area map: the sphere onto the disk of radius sqrt(2), the upper
// hemisphere onto the unit disk. A density over the plane is twice the density over solid angle.
// A rotation about z is a rotation of the plane, which is why one isotropic BRDF cache serves
// every azimuth; the square has no such property.
inline Vec2 direction_to_disk(const Vec3& w) {
  return Vec2(w.x(), w.y()) / std::sqrt(std::max(1 + w.z(), 1e-12f));
}
inline Vec3 disk_to_direction(const Vec2& y) {  // |y|^2 <= 2
  const float r2 = y.squaredNorm();
  const float scale = safe_sqrt(2 - r2);
  return {y.x() * scale, y.y() * scale, 1 - r2};
}
inline constexpr float kDiskMaxRadius2 = 2.0f;      // |y|^2 of the south pole
inline constexpr float kSteradianPerDiskArea = 2.0f;  // dw / dA

}  // namespace waylight
