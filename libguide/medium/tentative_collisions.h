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
    const float rate = factor * block.most;
    float t = block.t0;
    for (; depth < rate * (block.t1 - t); depth = exponential(random.next())) {
      t += depth / rate;
      if (!visit(t, rate)) return;
    }
    depth -= rate * (block.t1 - t);
  }
}

// The factor >= 1 with which at least `wanted` tentative collisions are expected along the blocks;
// 1 where there is no extinction.
inline float rate_factor(BlockWalk blocks, float wanted) {
  float depth = 0;
  for (RayBlock block; depth < wanted && blocks.next(block);) depth += block.most * block.length();
  return depth > 0 ? std::max(1.0f, wanted / depth) : 1.0f;
}

}  // namespace waylight
