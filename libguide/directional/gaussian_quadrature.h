#pragma once
// Quadrature over a bivariate Gaussian.

#include <cmath>

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/math/types.h"

namespace waylight {

// Of rings x spokes points of the unit square, which a radial warp takes to rings of equal
// probability; every other one is turned by half a spoke.
inline Vec2 ring_point(int i, int rings, int spokes) {
  const int ring = i / spokes, spoke = i % spokes;
  return {(static_cast<float>(ring) + 0.5f) / static_cast<float>(rings),
          (static_cast<float>(spoke) + 0.25f + 0.5f * (ring % 2)) / static_cast<float>(spokes)};
}

// Calls visit(y) for rings x spokes points, each of which stands for as much probability of c.
template <typename Visit>
void visit_quantiles(const GaussianComponent& c, int rings, int spokes, const Visit& visit) {
  const float l_xx = std::sqrt(c.cov_xx), slope = c.cov_xy / c.cov_xx;
  const float l_yy = safe_sqrt(c.cov_yy - slope * c.cov_xy);
  for (int i = 0; i < rings * spokes; ++i) {
    const Vec2 z = square_to_gaussian(ring_point(i, rings, spokes));
    visit(Vec2(c.mean_x + l_xx * z.x(), c.mean_y + slope * l_xx * z.x() + l_yy * z.y()));
  }
}

}  // namespace waylight
