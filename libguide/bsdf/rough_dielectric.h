#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/fresnel.h"
#include "libguide/bsdf/microfacet.h"

namespace waylight {

// Ground glass, seen from either side [Walter et al. 2007]. Everything is computed in the frame
// turned so that wo is above; there eta = n(below) / n(above).
struct RoughDielectric {
  float eta;  // n below / n above; not within 1e-4 of 1, where refraction has no half vector
  Color specular_reflectance, specular_transmittance;
  Microfacet facets;
  TransportMode mode;

  Color eval(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).value; }
  std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z() == 0) return std::nullopt;
    const float side = wo.z() > 0 ? 1.0f : -1.0f, relative = side > 0 ? eta : 1 / eta;
    const Vec3 w = side * wo, m = facets.sample(w, u2);
    const float cos_m = std::min(w.dot(m), 1.0f);
    if (!(cos_m > 0)) return std::nullopt;
    const Fresnel f = fresnel_dielectric(cos_m, relative);
    const bool reflected = u < reflect_prob(f.reflectance);
    const Vec3 wi =
        side * (reflected ? reflect(w, m).normalized() : refract(w, m, relative, f.cos_t));
    if (reflected != (wo.z() * wi.z() > 0)) return std::nullopt;
    const EvalPdf e = evaluate(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.value / e.pdf, e.pdf, reflected ? 1 : relative};
  }
  float pdf(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).pdf; }
  float delta_prob(const Vec3& /*wo*/) const { return 0; }
  std::optional<BsdfSample> sample_delta(const Vec3& /*wo*/, float /*u*/) const {
    return std::nullopt;
  }
  Color mean_reflectance() const {
    const float f = fresnel_diffuse_reflectance(eta);
    return f * specular_reflectance + (1 - f) * specular_transmittance;
  }

  // As of a smooth surface: the lobe is taken to be narrow.
  SideShares side_shares(const Vec3& wo) const {
    const float relative = wo.z() > 0 ? eta : 1 / eta;
    const float f = fresnel_dielectric(std::abs(wo.z()), relative).reflectance;
    const float scale = mode == TransportMode::radiance ? 1 / sqr(relative) : 1;
    return {f * luminance(specular_reflectance),
            (1 - f) * scale * luminance(specular_transmittance)};
  }

  EvalPdf evaluate(const Vec3& wo, const Vec3& wi) const {
    const float sides = wo.z() * wi.z();
    if (sides == 0) return {};
    const float side = wo.z() > 0 ? 1.0f : -1.0f, relative = side > 0 ? eta : 1 / eta;
    const Vec3 w = side * wo, v = side * wi;
    return sides > 0 ? reflection(w, v, relative) : refraction(w, v, relative);
  }

 private:
  float reflect_prob(float reflectance) const {
    return choice_prob(reflectance * specular_reflectance.mean(),
                       (1 - reflectance) * specular_transmittance.mean());
  }

  // As RoughConductor; visible normals times 1 / (4 wo.m).
  EvalPdf reflection(const Vec3& wo, const Vec3& wi, float relative) const {
    const Vec3 m = reflection_normal(wo, wi);
    const float f = fresnel_dielectric(std::min(wo.dot(m), 1.0f), relative).reflectance;
    const float density = 0.25f * facets.g1_over_cos(wo) * facets.d(m);
    return {specular_reflectance * (f * density * facets.g1(wi)), reflect_prob(f) * density};
  }

  // Visible normals times dm/dwi = eta^2 |wi.m| / (wo.m + eta wi.m)^2. In that measure the power
  // scattered is T G1(wi); radiance is less by 1/eta^2.
  EvalPdf refraction(const Vec3& wo, const Vec3& wi, float relative) const {
    Vec3 m = wo + relative * wi;
    m *= (m.z() > 0 ? 1 : -1) / m.norm();
    const float cos_o = wo.dot(m), cos_i = wi.dot(m);
    if (!(cos_o > 0 && cos_i < 0)) return {};
    const float f = fresnel_dielectric(std::min(cos_o, 1.0f), relative).reflectance;
    const float jacobian = sqr(relative) * -cos_i / sqr(cos_o + relative * cos_i);
    const float density = facets.g1_over_cos(wo) * cos_o * facets.d(m) * jacobian;
    const float scale = mode == TransportMode::radiance ? 1 / sqr(relative) : 1;
    return {specular_transmittance * ((1 - f) * density * facets.g1(-wi) * scale),
            (1 - reflect_prob(f)) * density};
  }
};

}  // namespace waylight
