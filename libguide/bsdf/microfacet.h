#pragma once
// Microfacet distributions with visible-normal sampling. All directions are on the upper side.
//
// Shadowing and masking are Smith's, separable, G = G1(wo) G1(wi), as in Mitsuba and Tungsten
// (the height-correlated form is brighter at grazing angles). For Beckmann, G1 is exact where those
// two use Walter's rational fit (within 0.4 %): visible normals then integrate to one.

#include "libguide/bsdf/material.h"
#include "libguide/math/types.h"

namespace waylight {

inline constexpr float kMinAlpha = 1e-4f;  // narrower lobes are lost in float directions

struct Microfacet {
  float alpha_u, alpha_v;  // at least kMinAlpha
  MicrofacetDistribution distribution;

  // Density of normals over projected solid angle: int D(m) cos(m) dm = 1.
  float d(const Vec3& m) const {
    if (m.z() <= 0) return 0;
    const float slope2 = sqr(m.x() / alpha_u) + sqr(m.y() / alpha_v), z2 = sqr(m.z());
    const float area = kPi * alpha_u * alpha_v;
    if (distribution == MicrofacetDistribution::ggx) return 1 / (area * sqr(slope2 + z2));
    if (!(slope2 < 80 * z2)) return 0;  // below 1e-34 of the peak; z2 may underflow
    return std::exp(-slope2 / z2) / (area * sqr(z2));
  }

  // G1(w) / cos(w), finite at the horizon; w.z > 0. The back-facing test is the caller's.
  float g1_over_cos(const Vec3& w) const {
    const float s2 = sqr(alpha_u * w.x()) + sqr(alpha_v * w.y()), z = w.z();
    if (distribution == MicrofacetDistribution::ggx) return 2 / (z + std::sqrt(sqr(z) + s2));
    const float s = std::sqrt(s2);
    if (z > 4 * s) return 1 / z;  // erfc(4) < 2e-8
    const float a = z / s;
    return 2 / (z * (1 + std::erf(a)) + s * std::exp(-sqr(a)) * kInvSqrtPi);
  }
  float g1(const Vec3& w) const { return w.z() * g1_over_cos(w); }

  // A normal seen from w, w.z > 0.
  Vec3 sample(const Vec3& w, const Vec2& u2) const {
    return distribution == MicrofacetDistribution::ggx ? sample_ggx(w, u2) : sample_beckmann(w, u2);
  }
  // Density per steradian of sample(): G1(w) max(w.m, 0) D(m) / cos(w).
  float pdf(const Vec3& w, const Vec3& m) const {
    return g1_over_cos(w) * std::max(w.dot(m), 0.0f) * d(m);
  }

 private:
  static constexpr float kInvSqrtPi = std::numbers::inv_sqrtpi_v<float>;

  Vec3 sample_ggx(const Vec3& w, const Vec2& u2) const;
  Vec3 sample_beckmann(const Vec3& w, const Vec2& u2) const;
};

// Half vector of a reflection.
inline Vec3 reflection_normal(const Vec3& wo, const Vec3& wi) { return (wo + wi).normalized(); }

}  // namespace waylight
