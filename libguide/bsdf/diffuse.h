#pragma once

#include "libguide/bsdf/bsdf_sample.h"
#include "libguide/math/warp.h"

namespace waylight {

// Lambertian reflection on the upper side.
struct Diffuse {
  Color reflectance;

  Color eval(const Vec3& wo, const Vec3& wi) const {
    if (wo.z() <= 0 || wi.z() <= 0) return Color::Zero();
    return reflectance * (kInvPi * wi.z());
  }
  std::optional<BsdfSample> sample(const Vec3& wo, float /*u*/, const Vec2& u2) const {
    if (wo.z() <= 0) return std::nullopt;
    const Vec3 wi = square_to_cosine_hemisphere(u2);
    const float density = cosine_hemisphere_pdf(wi);
    if (density <= 0) return std::nullopt;
    return BsdfSample{wi, reflectance, density};
  }
  float pdf(const Vec3& wo, const Vec3& wi) const {
    return wo.z() <= 0 || wi.z() <= 0 ? 0.0f : cosine_hemisphere_pdf(wi);
  }
  float delta_prob(const Vec3& /*wo*/) const { return 0; }
  std::optional<BsdfSample> sample_delta(const Vec3& /*wo*/, float /*u*/) const {
    return std::nullopt;
  }
  Color mean_reflectance() const { return reflectance; }
};

}  // namespace waylight
