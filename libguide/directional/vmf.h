#pragma once
// von Mises-Fisher lobes over the sphere. The density per steradian is
//   c(kappa) e^(kappa (mean . w - 1)),  c(kappa) = kappa / (2 pi (1 - e^(-2 kappa))),
// 1 / (4 pi) for kappa = 0; the mean of the directions is A(kappa) mean with the mean cosine
//   A(kappa) = coth kappa - 1 / kappa.
// mean . w - 1 is taken as -|w - mean|^2 / 2, which is exact to first order where the dot product of
// floats is off by 6e-8: times 1e5, that would be 0.6 % of the density.

#include "libguide/math/fast_exp.h"
#include "libguide/math/types.h"
#include "libguide/math/warp.h"
#include "libguide/records/vmf.h"

namespace waylight {

// Concentrations end here: a cone of 0.26 degrees, that of the sun. A is 1 - 1e-5 there, and the
// float resultants that caches store resolve no better than 6e-8 of it, 0.6 % of kappa.
inline constexpr float kMaxKappa = 1e5f;

// c(kappa), for kappa >= 0.
float vmf_norm(float kappa);

// The warp of the unit square to one lobe: forward, pdf, inverse. Samples never fall where the
// exponent is below -17: no density is lost to its clamp.
Vec3 sample_vmf(const Vec3& mean, float kappa, const Vec2& u);
float vmf_pdf(const Vec3& mean, float kappa, const Vec3& w);
Vec2 vmf_to_square(const Vec3& mean, float kappa, const Vec3& w);

// A(kappa) for kappa >= 0, in [0, 1).
double mean_cosine(double kappa);

// Its inverse for r in [0, 1), relative error below 1e-6: Newton's method from
// kappa = r (3 - r^2) / (1 - r^2) [Banerjee et al. 2005], which is within 3 %. The result is in
// [0, kMaxKappa], also beyond the range of r; 0 for NaN.
double kappa_of_mean_cosine(double r);

// c(kappa) of eight lobes; relative error below 3e-6.
inline Lanes lanes_vmf_norm(Lanes kappa) {
  const Lanes x = 2 * kappa, x2 = x * x;
  const Lanes series =
      1 + 0.5f * x + x2 * (1.0f / 12 - x2 * (1.0f / 720 - x2 * (1.0f / 30240)));
  const Lanes ratio = x / (1 - exp_clamped(-x));
  return kSpherePdf * (x < 0.5f ? series : ratio);
}

// The dispersion 1 - A(kappa) of eight lobes, which keeps the digits of narrow ones; relative error
// below 1e-5. Below 1 by the series of A.
inline Lanes lanes_dispersion(Lanes kappa) {
  const Lanes k2 = kappa * kappa;
  Lanes a = k2 * (2.0f / 93555) - 1.0f / 4725;
  a = a * k2 + 2.0f / 945;
  a = a * k2 - 1.0f / 45;
  a = a * k2 + 1.0f / 3;
  const Lanes e = exp_clamped(-2 * kappa);
  return kappa < 1.0f ? 1 - kappa * a : 1 / kappa - 2 * e / (1 - e);
}

// The kappa of a dispersion in (0, 1]; relative error below 3e-4. With s = (1 - dispersion)^2,
// kappa = r (3 - s + s (1 - s) q(s)) / (1 - s), q by a minimax fit.
inline Lanes lanes_kappa_of_dispersion(Lanes dispersion) {
  const Lanes r = 1 - dispersion, s = r * r;
  const Lanes one_minus_s = dispersion * (2 - dispersion);
  Lanes q = s * 0.902415075f - 1.04417231f;
  q = q * s - 0.12664372f;
  q = q * s - 0.207535996f;
  return r * (3 - s + s * one_minus_s * q) / one_minus_s;
}

}  // namespace waylight
