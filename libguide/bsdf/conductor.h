#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/bsdf/fresnel.h"

namespace waylight {

// Smooth metal on the upper side: one delta direction.
struct Conductor {
  Color eta, k;
  Color specular_reflectance;

  Color eval(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return Color::Zero(); }
  std::optional<BsdfSample> sample(const Vec3& /*wo*/, float /*u*/, const Vec2& /*u2*/) const {
    return std::nullopt;
  }
  float pdf(const Vec3& /*wo*/, const Vec3& /*wi*/) const { return 0; }
  float delta_prob(const Vec3& /*wo*/) const { return 1; }
  std::optional<BsdfSample> sample_delta(const Vec3& wo, float /*u*/) const {
    if (wo.z() <= 0) return std::nullopt;
    return BsdfSample{reflect(wo), specular_reflectance * fresnel_conductor(wo.z(), eta, k), 1};
  }
  Color mean_reflectance() const {
    // Schlick's curve has the mean F0 + (1 - F0) / 21.
    return specular_reflectance * (fresnel_conductor(1, eta, k) * (20.0f / 21) + 1.0f / 21);
  }
};

}  // namespace waylight
