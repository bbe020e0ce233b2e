#pragma once

#include "libguide/base/random_stream.h"

namespace waylight {

// Roulette on a share of light that is left along a ray: none as long as it is at least `faint`.
// Returns the factor of the share, 0 where the ray ends; its mean is 1.
inline float faint_roulette(float share, float faint, RandomStream& random) {
  if (share >= faint) return 1;
  return random.next() * faint < share ? faint / share : 0.0f;
}

}  // namespace waylight
