#pragma once
// Sunlight through the atmosphere.

#include "libguide/math/color_matching.h"

namespace waylight {

// Radiance of the sun's disk at a polar angle in [0, pi/2] for a turbidity, as CIE XYZ of the mean
// spectral radiance W / (m^2 sr nm): a flat spectrum of one has Y = 1.
Eigen::Array3d sun_xyz(double polar_angle, double turbidity);

}  // namespace waylight
