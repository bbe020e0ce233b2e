#include "libguide/directional/vmf.h"

#include "libguide/math/frame.h"

namespace waylight {
namespace {

constexpr float kFlatKappa = 1e-8f;    // below, the density is constant in float
constexpr double kSeriesKappa = 0.1;   // below, coth kappa - 1 / kappa cancels

// A'(kappa) = 1 - A^2 - 2 A / kappa; 1/3 - kappa^2 / 15 + ... where that cancels.
double mean_cosine_slope(double kappa, double a) {
  if (kappa < kSeriesKappa) return 1.0 / 3 - kappa * kappa / 15;
  return 1 - a * a - 2 * a / kappa;
}

}  // namespace

float vmf_norm(float kappa) {
  if (kappa < kFlatKappa) return kSpherePdf;
  return 0.5f * kInvPi * kappa / -std::expm1(-2 * kappa);
}

// 1 - cos theta = -log1p(u expm1(-2 kappa)) / kappa, and r^2 = d (2 - d) as for a narrow cone.
Vec3 sample_vmf(const Vec3& mean, float kappa, const Vec2& u) {
  const float d = kappa < kFlatKappa ? 2 * u.x()
                                     : -std::log1p(u.x() * std::expm1(-2 * kappa)) / kappa;
  const float below = std::clamp(d, 0.0f, 2.0f);
  const float r = safe_sqrt(below * (2 - below)), phi = 2 * kPi * u.y();
  return Frame(mean).to_world({r * std::cos(phi), r * std::sin(phi), 1 - below});
}

float vmf_pdf(const Vec3& mean, float kappa, const Vec3& w) {
  const float exponent = -0.5f * kappa * (w - mean).squaredNorm();
  return vmf_norm(kappa) * std::exp(std::max(exponent, kMinExponent));
}

Vec2 vmf_to_square(const Vec3& mean, float kappa, const Vec3& w) {
  const float d = 0.5f * (w - mean).squaredNorm();
  const Vec3 local = Frame(mean).to_local(w);
  const float azimuth = sphere_to_square(local).y();
  const float u = kappa < kFlatKappa ? 0.5f * d : std::expm1(-kappa * d) / std::expm1(-2 * kappa);
  return {std::clamp(u, 0.0f, kOneMinusEpsilon), azimuth};
}

double mean_cosine(double kappa) {
  if (!(kappa < kSeriesKappa)) return 1 / std::tanh(kappa) - 1 / kappa;
  const double k2 = kappa * kappa;
  return kappa * (1.0 / 3 - k2 * (1.0 / 45 - k2 * (2.0 / 945 - k2 / 4725)));
}

double kappa_of_mean_cosine(double r) {
  if (!(r > 0)) return 0;
  if (r >= 1) return kMaxKappa;
  double kappa = r * (3 - r * r) / (1 - r * r);
  for (int step = 0; step < 3 && kappa < 2 * kMaxKappa; ++step) {
    const double a = mean_cosine(kappa);
    kappa -= (a - r) / mean_cosine_slope(kappa, a);
  }
  return std::clamp<double>(kappa, 0, kMaxKappa);
}

}  // namespace waylight
