#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/fresnel.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"

namespace waylight {

// The modified Phong model, upper side [Lafortune, Willems 1994]:
//   f = diffuse / pi + specular (n + 2) / (2 pi) cos^n(angle between wi and the mirror of wo).
// It conserves energy while diffuse + specular <= 1.
struct Phong {
  Color diffuse, specular;
  float exponent;  // >= 0

  Color eval(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).value; }
  std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z() <= 0) return std::nullopt;
    const Vec3 wi = u < specular_prob() ? sample_lobe(wo, u2) : square_to_cosine_hemisphere(u2);
    const EvalPdf e = evaluate(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.value / e.pdf, e.pdf};
  }
  float pdf(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).pdf; }
  float delta_prob(const Vec3& /*wo*/) const { return 0; }
  std::optional<BsdfSample> sample_delta(const Vec3& /*wo*/, float /*u*/) const {
    return std::nullopt;
  }
  Color mean_reflectance() const { return diffuse + specular; }

  EvalPdf evaluate(const Vec3& wo, const Vec3& wi) const {
    if (wo.z() <= 0 || wi.z() <= 0) return {};
    // 1 - cos = |wi - mirror|^2 / 2 keeps its digits where a large exponent needs them.
    const float versine = 0.5f * (wi - reflect(wo)).squaredNorm();
    const float power = versine < 1 ? std::exp(exponent * std::log1p(-versine)) : 0;
    const float lobe = power * (0.5f * kInvPi), cosine = cosine_hemisphere_pdf(wi);
    return {diffuse * cosine + specular * ((exponent + 2) * lobe * wi.z()),
            lerp(cosine, (exponent + 1) * lobe, specular_prob())};
  }

 private:
  float specular_prob() const { return choice_prob(specular.mean(), diffuse.mean(), 0.05f); }

  // Density (n + 1) / (2 pi) cos^n about the mirror direction; may fall below the surface.
  Vec3 sample_lobe(const Vec3& wo, const Vec2& u2) const {
    const float versine = -std::expm1(std::log(u2.x()) / (exponent + 1));
    const float r = safe_sqrt(versine * (2 - versine)), phi = 2 * kPi * u2.y();
    const Vec3 local(r * std::cos(phi), r * std::sin(phi), 1 - versine);
    return Frame(reflect(wo)).to_world(local).normalized();
  }
};

}  // namespace waylight
