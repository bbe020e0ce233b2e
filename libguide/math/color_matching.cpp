#include "libguide/math/color_matching.h"

#include <cmath>

namespace waylight {
namespace {

double lobe(double x, double mean, double left, double right) {
  const double t = (x - mean) / (x < mean ? left : right);
  return std::exp(-0.5 * t * t);
}

}  // namespace

// Piecewise Gaussian fit of the colour matching functions [Wyman, Sloan, Shirley 2013].
Eigen::Array3d color_matching(double nm) {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
              0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

Eigen::Array3d xyz_to_linear_srgb(const Eigen::Array3d& xyz) {
  Eigen::Matrix3d m;
  m << 3.240479, -1.537150, -0.498535, -0.969256, 1.875991, 0.041556, 0.055648, -0.204043, 1.057311;
  return (m * xyz.matrix()).array();
}

}  // namespace waylight
