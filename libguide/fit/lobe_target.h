#pragma once
// What a mixture is fitted to: f of one wo, without the cosine, as a function of wi.

#include <optional>

#include "libguide/base/sampler.h"
#include "libguide/bsdf/bsdf.h"
#include "libguide/math/warp.h"

namespace waylight {

// Directions are in the frame in which wo is given: z the shading normal, x the horizontal part of
// wo or, for lobes that are anisotropic, that of the shading frame.
class LobeTarget {
 public:
  LobeTarget(const Bsdf& bsdf, const Vec3& wo) : bsdf_(bsdf), wo_(wo) {}

  struct Value {
    float f = 0;    // luminance of f, 1/sr; zero below the horizon
    float pdf = 0;  // with which the BSDF's own sampler makes the direction, per steradian
  };
  Value evaluate(const Vec3& wi) const {
    if (!(wi.z() > 0)) return {};
    const EvalPdf e = bsdf_.evaluate(wo_, wi);
    return {luminance(e.value) / wi.z(), e.pdf};
  }
  // By the BSDF's own sampler, which knows the value of what it draws.
  struct Sample {
    Vec3 wi;
    Value value;
  };
  std::optional<Sample> sample_value(float u, const Vec2& u2) const {
    const std::optional<BsdfSample> s = bsdf_.sample(wo_, u, u2);
    if (!s || !(s->wi.z() > 0)) return std::nullopt;
    return Sample{s->wi, {luminance(s->weight) * (s->pdf / s->wi.z()), s->pdf}};
  }
  std::optional<Vec3> sample(float u, const Vec2& u2) const {
    const std::optional<Sample> s = sample_value(u, u2);
    return s ? std::optional<Vec3>(s->wi) : std::nullopt;
  }

 private:
  const Bsdf& bsdf_;
  Vec3 wo_;
};

inline constexpr float kHemispherePdf = 0.5f * kInvPi;

// Uniform over the upper hemisphere.
inline Vec3 square_to_hemisphere(const Vec2& u) { return disk_to_direction(square_to_disk(u)); }

}  // namespace waylight
