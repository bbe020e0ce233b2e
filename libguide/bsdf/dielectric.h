#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/fresnel.h"

namespace waylight {

// Smooth glass, seen from either side: two delta directions.
struct Dielectric {
  float eta;  // n below / n above
  Color specular_reflectance, specular_transmittance;
  TransportMode mode;

  Color eval(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return Color::Zero(); }
  std::optional<BsdfSample> sample(const Vec3& /*wo*/, float /*u*/, const Vec2& /*u2*/) const {
    return std::nullopt;
  }
  float pdf(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return 0; }
  float delta_prob(const Vec3& /*wo*/) const { return 1; }
  // Refraction: weight T / eta^2 for radiance, T for importance, with eta = n(wi) / n(wo).
  std::optional<BsdfSample> sample_delta(const Vec3& wo, float u) const {
    const float side = wo.z() >= 0 ? 1.0f : -1.0f;
    const float relative = side > 0 ? eta : 1 / eta;
    const Fresnel f = fresnel_dielectric(std::min(std::abs(wo.z()), 1.0f), relative);
    const float transmittance = 1 - f.reflectance;
    const float prob = choice_prob(f.reflectance * specular_reflectance.mean(),
                                   transmittance * specular_transmittance.mean());
    if (u < prob)
      return BsdfSample{reflect(wo), specular_reflectance * (f.reflectance / prob), prob};
    if (!(transmittance > 0)) return std::nullopt;
    const float scale = mode == TransportMode::radiance ? 1 / sqr(relative) : 1;
    return BsdfSample{refract(wo, side * Vec3::UnitZ(), relative, f.cos_t),
                      specular_transmittance * (transmittance * scale / (1 - prob)), 1 - prob,
                      relative};
  }
  Color mean_reflectance() const {
    const float f = fresnel_diffuse_reflectance(eta);
    return f * specular_reflectance + (1 - f) * specular_transmittance;
  }
};

}  // namespace waylight
