#pragma once
// The octahedron |x| + |y| + |z| = 1 unfolded onto the square [-1, 1]^2 [Cigolle et al. 2014, A
// Survey of Efficient Representations for Independent Unit Vectors].

#include "libguide/math/types.h"

namespace waylight {

// w: finite and not zero; its length does not matter.
inline Vec2 direction_to_octahedral(const Vec3& w) {
  const float scale = 1 / (std::abs(w.x()) + std::abs(w.y()) + std::abs(w.z()));
  const float x = w.x() * scale, y = w.y() * scale;
  if (w.z() >= 0) return {x, y};
  return {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y)};  // folded over
}

// A unit vector.
inline Vec3 octahedral_to_direction(const Vec2& p) {
  const float z = 1 - std::abs(p.x()) - std::abs(p.y());
  const float inside = std::max(-z, 0.0f);  // how far beyond the fold
  const float x = p.x() - std::copysign(inside, p.x()), y = p.y() - std::copysign(inside, p.y());
  const float scale = 1 / std::sqrt(x * x + y * y + z * z);
  return {x * scale, y * scale, z * scale};
}

}  // namespace waylight
