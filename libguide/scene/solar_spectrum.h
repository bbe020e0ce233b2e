#pragma once
// Sunlight through the atmosphere, and its colour.

#include <Eigen/Core>

namespace waylight {

// Integral of the CIE 1931 luminance function over wavelength, nm.
inline constexpr double kLuminanceIntegral = 106.857;

// Radiance of the sun's disk at a polar angle in [0, pi/2] for a turbidity, as CIE XYZ of the mean
// spectral radiance W / (m^2 sr nm): a flat spectrum of one has Y = 1.
Eigen::Array3d sun_xyz(double polar_angle, double turbidity);

Eigen::Array3d xyz_to_linear_srgb(const Eigen::Array3d& xyz);  // white point D65

}  // namespace waylight
