#pragma once
// Phase functions: densities over the sphere, per steradian. `forward` is the direction of travel,
// -wo; `cosine` is that between it and wi.

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/medium/medium.h"

namespace waylight {

// [Henyey, Greenstein 1941]
inline float henyey_greenstein(float g, float cosine) {
  const float d = 1 + g * g - 2 * g * cosine;
  return 0.25f * kInvPi * (1 - g * g) / (d * safe_sqrt(d));
}

// The cosine whose cumulative density is u. For small g the inverse cancels; to first order it is
// that of the linear density (1 + 3 g c) / 2.
inline float sample_henyey_greenstein(float g, float u) {
  const float s = 2 * u - 1;
  if (std::abs(g) < 1e-3f) return std::clamp(s + 1.5f * g * (1 - s * s), -1.0f, 1.0f);
  const float r = (1 - g * g) / (1 + g * s);
  return std::clamp((1 + g * g - r * r) / (2 * g), -1.0f, 1.0f);
}

// The mean cosine g; 0 where light scatters the same to all sides.
inline float mean_cosine(const PhaseFunction& phase) {
  const auto* hg = std::get_if<HenyeyGreenstein>(&phase);
  return hg ? hg->g : 0.0f;
}

// eval and pdf in one: phase functions are sampled exactly.
inline float phase_pdf(const PhaseFunction& phase, float cosine) {
  const float g = mean_cosine(phase);
  return g == 0 ? kSpherePdf : henyey_greenstein(g, cosine);
}

inline Vec3 sample_phase(const PhaseFunction& phase, const Vec3& forward, const Vec2& u) {
  const float cosine = sample_henyey_greenstein(mean_cosine(phase), u.x());
  const float sine = safe_sqrt(1 - cosine * cosine), angle = 2 * kPi * u.y();
  return Frame(forward).to_world({sine * std::cos(angle), sine * std::sin(angle), cosine});
}

}  // namespace waylight
