#pragma once
// Transmittance of a rough dielectric interface, tabulated over roughness and elevation.

#include <array>

#include "libguide/bsdf/material.h"

namespace waylight {

// For isotropic microfacets, light from above, eta = n(below) / n(above):
//   T(alpha, cos) = E_m[(1 - F(w.m)) G1(refracted w)]    over visible normals m,
//   R(alpha)      = 2 int_0^1 E_m[F G1(reflected w)] cos dcos   for light from below.
// Single scattering: what shadowing loses is lost, so that T and the reflection stay below one.
class RoughTransmittance {
 public:
  RoughTransmittance(MicrofacetDistribution distribution, float eta);

  // A roughness, looked up once per shading point.
  struct Row {
    int index;
    float fraction;
  };
  Row row(float alpha) const;
  float transmittance(Row row, float cos) const;
  float internal_reflectance(Row row) const;

 private:
  // Nodes: alpha = (i / 19)^2 of at least kMinAlpha; cos = (j / 47)^2, dense where F is steep.
  static constexpr int kAlphas = 20, kCosines = 48;
  std::array<std::array<float, kCosines>, kAlphas> transmittance_;
  std::array<float, kAlphas> internal_;
};

// The table of one kind of interface, made at first use and kept; thread-safe, and a function of
// its arguments alone.
const RoughTransmittance& rough_transmittance(MicrofacetDistribution distribution, float eta);

}  // namespace waylight
