#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/choice.h"
#include "libguide/bsdf/fresnel.h"

namespace waylight {

// A pane thinner than a pixel: reflections between its faces add up to R + T^2 R / (1 - R^2) =
// 2 R / (1 + R), and transmitted light goes straight on.
struct ThinDielectric {
  float eta;  // inside the pane / outside
  Color specular_reflectance, specular_transmittance;

  Color eval(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return Color::Zero(); }
  std::optional<BsdfSample> sample(const Vec3& /*wo*/, float /*u*/, const Vec2& /*u2*/) const {
    return std::nullopt;
  }
  float pdf(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return 0; }
  float delta_prob(const Vec3& /*wo*/) const { return 1; }
  std::optional<BsdfSample> sample_delta(const Vec3& wo, float u) const {
    const float reflectance = pane_reflectance(wo), transmittance = 1 - reflectance;
    const float prob = choice_prob(reflectance * specular_reflectance.mean(),
                                   transmittance * specular_transmittance.mean());
    if (u < prob) return BsdfSample{reflect(wo), specular_reflectance * (reflectance / prob), prob};
    if (!(transmittance > 0)) return std::nullopt;
    return BsdfSample{-wo, specular_transmittance * (transmittance / (1 - prob)), 1 - prob, 1, true};
  }
  Color straight_transmission(const Vec3& wo) const {
    return (1 - pane_reflectance(wo)) * specular_transmittance;
  }
  Color mean_reflectance() const {
    const float f = fresnel_diffuse_reflectance(eta), pane = 2 * f / (1 + f);
    return pane * specular_reflectance + (1 - pane) * specular_transmittance;
  }

 private:
  float pane_reflectance(const Vec3& wo) const {
    const float f = fresnel_dielectric(std::min(std::abs(wo.z()), 1.0f), eta).reflectance;
    return 2 * f / (1 + f);
  }
};

}  // namespace waylight
