#pragma once
// Exponentials of eight lanes at once, of bounded error and range.

#include "libguide/math/lanes.h"

namespace waylight {

inline constexpr float kLog2E = 1.44269504f;

// The exponent is clamped here from below: e^-80 = 2^-115.4 is a normal float with room for a
// factor of 1e-3. Underflowing exponents cost 3 to 9 times the time.
inline constexpr float kMinExponent = -80.0f;

// 2^(n + r) for |r| <= 1/2; the integer n is in the low bits of `shifted` = n + 1.5 2^23.
// 2^r by its minimax polynomial of degree 5 (7.5e-8 by itself).
inline Lanes exp2_parts(Lanes shifted, Lanes r) {
  Lanes p = r * 0.0013276472168f + 0.00967554133102f;
  p = p * r + 0.05550713272876f;
  p = p * r + 0.24022119723969f;
  p = p * r + 0.69314696706527f;
  p = p * r + 1.00000007165464f;
  const IntLanes exponent = reinterpret_cast<IntLanes>(shifted) << 23;
  return reinterpret_cast<Lanes>(reinterpret_cast<IntLanes>(p) + exponent);
}

// 2^x for x up to 126, 2^max(x, -80 log2 e) below; relative error below 3e-7. A NaN gives the value
// of the clamp.
inline Lanes exp2_clamped(Lanes x) {
  x = lanes_max(x, splat(kMinExponent * kLog2E));
  const Lanes shifted = x + 0x1.8p23f;
  return exp2_parts(shifted, x - (shifted - 0x1.8p23f));
}

// e^x for x up to 87, e^max(x, -80) below; relative error below 1e-6. ln 2 is taken in two parts:
// the rounding of x log2(e) alone would cost |x| 6e-8.
inline Lanes exp_clamped(Lanes x) {
  x = lanes_max(x, splat(kMinExponent));
  const Lanes shifted = x * kLog2E + 0x1.8p23f;
  const Lanes n = shifted - 0x1.8p23f;
  const Lanes rest = (x - n * 0.693359375f) + n * 2.12194440e-4f;
  return exp2_parts(shifted, rest * kLog2E);
}

}  // namespace waylight
