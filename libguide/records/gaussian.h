#pragma once

namespace waylight {

// One weighted bivariate Gaussian over the equal-area disk (math/warp.h), as caches store it.
struct GaussianComponent {
  float weight = 0;
  float mean_x = 0, mean_y = 0;
  float cov_xx = 1, cov_xy = 0, cov_yy = 1;
};

}  // namespace waylight
