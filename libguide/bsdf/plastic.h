#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/fresnel.h"
#include "libguide/math/warp.h"

namespace waylight {

// Light that enters a diffuse base and leaves it again, relative to the transmission on its way in
// and out: rho / (1 - rho R) / eta^2 with R the internal reflectance of the coat for diffuse
// light. The linear variant keeps the hue of rho: rho / (1 - R) / eta^2.
inline Color coated_diffuse(const Color& rho, float internal, float eta, bool nonlinear) {
  const Color loss = nonlinear ? Color(1 - internal * rho) : Color::Constant(1 - internal);
  return rho / (sqr(eta) * loss);
}

// A smooth dielectric coat over a diffuse base, upper side: delta reflection of the coat, and
// f cos(wi) = T(wo) T(wi) coated_diffuse cos(wi) / pi.
struct Plastic {
  float eta;       // inside / outside
  float internal;  // fresnel_diffuse_reflectance(1 / eta)
  Color diffuse;   // coated_diffuse
  Color specular_reflectance;

  Color eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z() <= 0 || wi.z() <= 0) return Color::Zero();
    return diffuse * (transmittance(wo) * transmittance(wi) * kInvPi * wi.z());
  }
  std::optional<BsdfSample> sample(const Vec3& wo, float /*u*/, const Vec2& u2) const {
    if (wo.z() <= 0) return std::nullopt;
    const Vec3 wi = square_to_cosine_hemisphere(u2);
    const float density = cosine_hemisphere_pdf(wi);
    if (density <= 0) return std::nullopt;
    return BsdfSample{wi, diffuse * (transmittance(wo) * transmittance(wi)), density};
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    return wo.z() <= 0 || wi.z() <= 0 ? 0.0f : cosine_hemisphere_pdf(wi);
  }
  // Shares of the reflected light: that of the base is T(wo) diffuse (1 - internal) eta^2, as
  // 2 int T cos dcos = (1 - internal) eta^2.
  float delta_prob(const Vec3& wo) const {
    if (wo.z() <= 0) return 0;
    const float t = transmittance(wo);
    return choice_prob((1 - t) * specular_reflectance.mean(),
                       t * diffuse.mean() * (1 - internal) * sqr(eta), 0.02f);
  }
  std::optional<BsdfSample> sample_delta(const Vec3& wo, float /*u*/) const {
    if (wo.z() <= 0) return std::nullopt;
    return BsdfSample{reflect(wo), specular_reflectance * (1 - transmittance(wo)), 1};
  }
  Color mean_reflectance() const {
    const float entering = (1 - internal) * sqr(eta);
    return (1 - entering) * specular_reflectance + sqr(entering) * diffuse;
  }

 private:
  float transmittance(const Vec3& w) const {
    return 1 - fresnel_dielectric(std::min(w.z(), 1.0f), eta).reflectance;
  }
};

}  // namespace waylight
