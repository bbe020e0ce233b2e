#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/fresnel.h"
#include "libguide/bsdf/microfacet.h"
#include "libguide/bsdf/plastic.h"
#include "libguide/bsdf/rough_transmittance.h"

namespace waylight {

// A rough dielectric coat over a diffuse base, upper side, as Mitsuba 3 has it: microfacet
// reflection of the coat, and T(wo) T(wi) coated_diffuse cos(wi) / pi with the T of
// RoughTransmittance. (Tungsten takes the T of the smooth coat instead.)
struct RoughPlastic {
  float eta;      // inside / outside
  Color diffuse;  // coated_diffuse with the internal reflectance of the rough coat
  Color specular_reflectance;
  Microfacet facets;  // isotropic
  const RoughTransmittance* table;
  RoughTransmittance::Row row;

  Color eval(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).value; }
  std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z() <= 0) return std::nullopt;
    const bool specular = u < specular_prob(wo, transmittance(wo));
    const Vec3 wi = specular ? reflect(wo, facets.sample(wo, u2)).normalized()
                             : square_to_cosine_hemisphere(u2);
    const EvalPdf e = evaluate(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.value / e.pdf, e.pdf};
  }
  float pdf(const Vec3& wo, const Vec3& wi) const { return evaluate(wo, wi).pdf; }
  float delta_prob(const Vec3& /*wo*/) const { return 0; }
  std::optional<BsdfSample> sample_delta(const Vec3& /*wo*/, float /*u*/) const {
    return std::nullopt;
  }
  Color mean_reflectance() const {
    const float entering = 1 - fresnel_diffuse_reflectance(eta);
    return (1 - entering) * specular_reflectance + sqr(entering) * diffuse;
  }

  EvalPdf evaluate(const Vec3& wo, const Vec3& wi) const {
    if (wo.z() <= 0 || wi.z() <= 0) return {};
    const Vec3 m = reflection_normal(wo, wi);
    const float f = fresnel_dielectric(std::min(wo.dot(m), 1.0f), eta).reflectance;
    const float density = 0.25f * facets.g1_over_cos(wo) * facets.d(m);
    const float t = transmittance(wo), prob = specular_prob(wo, t);
    const float cosine = cosine_hemisphere_pdf(wi);
    return {specular_reflectance * (f * density * facets.g1(wi)) +
                diffuse * (t * transmittance(wi) * cosine),
            lerp(cosine, density, prob)};
  }

 private:
  float transmittance(const Vec3& w) const { return table->transmittance(row, w.z()); }

  // Estimated shares of the reflected light: F of the mean plane against what comes back out.
  float specular_prob(const Vec3& wo, float t) const {
    const float f = fresnel_dielectric(std::min(wo.z(), 1.0f), eta).reflectance;
    return choice_prob(f * specular_reflectance.mean(), t * diffuse.mean(), 0.05f);
  }
};

}  // namespace waylight
