#pragma once
// Directions within a cone about z given by its height h = 1 - cos of the half angle. The sun's
// cone has h = 1.1e-5: of its cosine a float keeps two digits that matter, of h all.

#include "libguide/math/types.h"

namespace waylight {

inline Vec3 square_to_cone_of_height(const Vec2& u, float height) {
  const float h = u.x() * height, phi = 2 * kPi * u.y();
  const float r = safe_sqrt(h * (2 - h));
  return {r * std::cos(phi), r * std::sin(phi), 1 - h};
}
inline float cone_of_height_pdf(float height) { return 0.5f * kInvPi / height; }
// |w - axis|^2 = 2 (1 - cos): the difference of close unit vectors is exact, their dot product is
// not. The margin covers the rounding of w's components for the sun's cone.
inline bool inside_cone_of_height(const Vec3& w, const Vec3& axis, float height) {
  return (w - axis).squaredNorm() <= 2 * height * (1 + 3e-5f);
}

}  // namespace waylight
