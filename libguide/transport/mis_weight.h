#pragma once

namespace waylight {

// Power heuristic with exponent two for one sample of each technique [Veach 1997, 9.2.4].
inline float mis_weight(float pdf, float other) {
  if (!(pdf < 1e18f)) return 1;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

}  // namespace waylight
