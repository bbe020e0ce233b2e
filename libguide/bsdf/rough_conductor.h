#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/conductor.h"
#include "libguide/bsdf/microfacet.h"

namespace waylight {

// f cos(wi) = F D G1(wo) G1(wi) / (4 cos(wo)) on the upper side [Walter et al. 2007].
struct RoughConductor {
  Color eta, k;
  Color specular_reflectance;
  Microfacet facets;

  Color eval(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).value; }
  std::optional<BsdfSample> sample(const Vec3& wo, float /*u*/, const Vec2& u2) const {
    if (wo.z() <= 0) return std::nullopt;
    const Vec3 wi = reflect(wo, facets.sample(wo, u2)).normalized();
    const EvalPdf e = evaluate(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.value / e.pdf, e.pdf};
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    if (wo.z() <= 0 || wi.z() <= 0) return 0;
    return reflected_pdf(wo, reflection_normal(wo, wi));
  }
  float delta_prob(const Vec3& /*wo*/) const { return 0; }
  std::optional<BsdfSample> sample_delta(const Vec3& /*wo*/, float /*u*/) const {
    return std::nullopt;
  }
  Color mean_reflectance() const {
    return Conductor{eta, k, specular_reflectance}.mean_reflectance();
  }

  EvalPdf evaluate(const Vec3& wo, const Vec3& wi) const {
    if (wo.z() <= 0 || wi.z() <= 0) return {};
    const Vec3 m = reflection_normal(wo, wi);
    const float density = reflected_pdf(wo, m);
    const Color f = specular_reflectance * fresnel_conductor(std::min(wo.dot(m), 1.0f), eta, k);
    return {f * (density * facets.g1(wi)), density};
  }

 private:
  // Visible normals have the density G1(wo) D (wo.m) / cos(wo), the reflection 1 / (4 wo.m).
  float reflected_pdf(const Vec3& wo, const Vec3& m) const {
    return 0.25f * facets.g1_over_cos(wo) * facets.d(m);
  }
};

}  // namespace waylight
