#pragma once

#include "libguide/base/random_stream.h"
#include "libguide/medium/extinction_blocks.h"

namespace waylight {

// Calls visit(t, rate) for each point of a Poisson process along the blocks of a ray, in order,
// until it says false; its rate is `factor` >= 1 times the majorant of the block [Woodcock et al.
// 1965]. u: uniform in [0, 1), decides where the first point is.
template <typename Visit>
void tentative_collisions(BlockWalk blocks, float factor, float u, RandomStream& random,
                          const Visit& visit) {
  const auto exponential = [](float v) { return -std::log1p(-v); };
  float depth = exponential(u);  // optical, left until the next collision
  for (RayBlock block; blocks.next(block);) {
    const float rate = factor * block.most, length = block.length();
    float along = 0;  // from where the block begins: far away, t has no steps as small
    for (; depth < rate * (length - along); depth = exponential(random.next())) {
      along += depth / rate;
      if (!visit(block.t0 + along, rate)) return;
    }
    depth -= rate * (length - along);
  }
}

// The factor >= 1 with which at least `wanted` tentative collisions are expected along the blocks,
// or fewer where it would be above 1e30; 1 where there is no extinction.
inline float rate_factor(BlockWalk blocks, float wanted) {
  float depth = 0;
  for (RayBlock block; depth < wanted && blocks.next(block);) depth += block.most * block.length();
  return depth > 0 ? std::clamp(wanted / depth, 1.0f, 1e30f) : 1.0f;
}

}  // namespace waylight
