#pragma once
// Unit vectors in two signed 16-bit numbers.

#include <cstdint>

#include "libguide/math/octahedral.h"

namespace waylight {

struct Octahedral {
  int16_t u = 0, v = 0;
};

namespace octahedral_detail {

inline int16_t quantize(float v) { return static_cast<int16_t>(std::lrint(v * 32767.0f)); }
inline float dequantize(int16_t v) { return std::max(v * (1 / 32767.0f), -1.0f); }

}  // namespace octahedral_detail

// w: finite and not zero.
inline Octahedral to_octahedral(const Vec3& w) {
  const Vec2 p = direction_to_octahedral(w);
  return {octahedral_detail::quantize(p.x()), octahedral_detail::quantize(p.y())};
}

inline Vec3 from_octahedral(const Octahedral& o) {
  return octahedral_to_direction(
      {octahedral_detail::dequantize(o.u), octahedral_detail::dequantize(o.v)});
}

}  // namespace waylight
