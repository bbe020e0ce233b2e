#pragma once
// Phase functions: densities over the sphere, per steradian. `forward` is the direction of travel,
// -wo.

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/medium/medium.h"

namespace waylight {

// [Henyey, Greenstein 1941], g in [0, 1), by v = 1 - cosine: near the peak of a narrow one the
// cosine has lost what tells directions apart.
inline float henyey_greenstein(float g, float v) {
  const float d = sqr(1 - g) + 2 * g * v;
  return 0.25f * kInvPi * (1 - g) * (1 + g) / (d * std::sqrt(d));
}

// The v whose cumulative density is 1 - u.
inline float sample_henyey_greenstein(float g, float u) {
  const float below = 1 - g, s = below + 2 * g * u;
  return std::min(below * (1 - u) * (below * (1 + g) / s + below) / s, 2.0f);
}

// The mean cosine g; 0 where light scatters the same to all sides.
inline float mean_cosine(const PhaseFunction& phase) {
  const auto* hg = std::get_if<HenyeyGreenstein>(&phase);
  return hg ? hg->g : 0.0f;
}

// eval and pdf in one: phase functions are sampled exactly.
inline float phase_pdf(const PhaseFunction& phase, const Vec3& forward, const Vec3& wi) {
  const float g = mean_cosine(phase);
  if (g == 0) return kSpherePdf;
  const Vec3 off_peak = g > 0 ? Vec3(wi - forward) : Vec3(wi + forward);
  return henyey_greenstein(std::abs(g), 0.5f * off_peak.squaredNorm());
}

inline Vec3 sample_phase(const PhaseFunction& phase, const Vec3& forward, const Vec2& u) {
  const float g = mean_cosine(phase), v = sample_henyey_greenstein(std::abs(g), u.x());
  const float sine = safe_sqrt(v * (2 - v)), angle = 2 * kPi * u.y();
  const Vec3 about_peak(sine * std::cos(angle), sine * std::sin(angle), 1 - v);
  return Frame(g < 0 ? Vec3(-forward) : forward).to_world(about_peak);
}

}  // namespace waylight
