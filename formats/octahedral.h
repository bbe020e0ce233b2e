#pragma once
// Unit vectors in two signed 16-bit numbers: the octahedron |x| + |y| + |z| = 1 unfolded onto a
// square [Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit Vectors].

#include <cstdint>

#include "libguide/math/types.h"

namespace waylight {

struct Octahedral {
  int16_t u = 0, v = 0;
};

namespace octahedral_detail {

// The lower half is folded over the diagonals of the upper one; its own inverse.
inline Vec2 fold(float x, float y) {
  return {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y)};
}
inline int16_t quantize(float v) { return static_cast<int16_t>(std::lrint(v * 32767.0f)); }
inline float dequantize(int16_t v) { return std::max(v * (1 / 32767.0f), -1.0f); }

}  // namespace octahedral_detail

// w: finite and not zero.
inline Octahedral to_octahedral(const Vec3& w) {
  using namespace octahedral_detail;
  const float scale = 1 / (std::abs(w.x()) + std::abs(w.y()) + std::abs(w.z()));
  Vec2 p(w.x() * scale, w.y() * scale);
  if (w.z() < 0) p = fold(p.x(), p.y());
  return {quantize(p.x()), quantize(p.y())};
}

inline Vec3 from_octahedral(const Octahedral& o) {
  using namespace octahedral_detail;
  const float u = dequantize(o.u), v = dequantize(o.v);
  const float z = 1 - std::abs(u) - std::abs(v);
  const float inside = std::max(-z, 0.0f);  // how far beyond the fold
  const float x = u - std::copysign(inside, u), y = v - std::copysign(inside, v);
  const float scale = 1 / std::sqrt(x * x + y * y + z * z);
  return {x * scale, y * scale, z * scale};
}

}  // namespace waylight
