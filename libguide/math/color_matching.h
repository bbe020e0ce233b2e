#pragma once
// From spectra to colours.

#include <Eigen/Core>

namespace waylight {

// Integral of the CIE 1931 luminance function over wavelength, nm.
inline constexpr double kLuminanceIntegral = 106.857;

// CIE 1931 colour matching functions x, y, z at a wavelength in nm.
Eigen::Array3d color_matching(double nm);

// CIE XYZ of white, the standard illuminant D65 of luminance 1.
inline Eigen::Array3d white_xyz() { return {0.950456, 1, 1.088754}; }

Eigen::Array3d xyz_to_linear_srgb(const Eigen::Array3d& xyz);  // white point D65

}  // namespace waylight
