#pragma once
// Logarithms of eight lanes at once.

#include "libguide/math/lanes.h"

namespace waylight {

// log2 v for positive normal v; absolute error below 2e-7 + 1e-7 |log2 v|. With v = 2^n m and m in
// [sqrt(1/2), sqrt(2)): n + 2/ln 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.172, by its series.
inline Lanes lanes_log2(Lanes v) {
  constexpr int32_t kOne = 0x3f800000, kSqrtHalf = 0x3f3504f3;
  const IntLanes bits = reinterpret_cast<IntLanes>(v) + (kOne - kSqrtHalf);
  const IntLanes exponent = (bits >> 23) - 127;
  const IntLanes mantissa = (bits & 0x7fffff) + kSqrtHalf;
  const Lanes m = reinterpret_cast<Lanes>(mantissa);
  const Lanes s = (m - 1) / (m + 1), s2 = s * s;
  Lanes p = s2 * (1.0f / 9) + 1.0f / 7;
  p = p * s2 + 1.0f / 5;
  p = p * s2 + 1.0f / 3;
  p = p * s2 + 1.0f;
  return __builtin_convertvector(exponent, Lanes) + p * s * 2.88539008f;
}

}  // namespace waylight
