#pragma once
// The directional decision of one path vertex: delta lobe, BSDF or guide.

#include <optional>

#include "libguide/directional/gaussian_product.h"
#include "libguide/guiding/guiding_caches.h"
#include "libguide/scene/scene.h"

namespace waylight {

enum class DirectionGuide { none, illumination, product };

struct DirectionSample {
  Vec3 wi;        // world space
  Color weight;   // f |cos| / pdf of everything chosen here
  float pdf = 0;  // of the smooth part, per steradian, the chance of choosing it included
  bool is_delta = false;
  float eta = 1;
  Color bsdf_weight;  // the weight that BSDF sampling would have given; drives Russian roulette
};

// Density over the smooth part:
//   p(wi) = (1 - P_delta) [(1 - g) p_bsdf(wi) + g p_guide(wi)],
// one-sample MIS with g the guiding probability where a guide is at hand and 0 elsewhere, so the
// density is positive wherever the BSDF's own is. p_guide is a sub-density: what falls below the
// horizon or outside the plane, or where f is zero, is a sample of value zero. No such sample is
// returned, and the density is zero there.
class DirectionSampler {
 public:
  DirectionSampler(const Scene& scene, const GuidingCaches& caches, DirectionGuide guide,
                   float guiding_prob, const SurfacePoint& at, const Vec3& wo,
                   TransportMode mode = TransportMode::radiance);
  DirectionSampler(const DirectionSampler&) = delete;
  DirectionSampler& operator=(const DirectionSampler&) = delete;

  // f(wo, wi) |cos wi| of the smooth part; zero where geometric and shading side disagree.
  Color eval(const Vec3& wi) const { return evaluate(wi).value; }
  std::optional<DirectionSample> sample(float u, float u_lobe, const Vec2& u2) const;
  float pdf(const Vec3& wi) const { return evaluate(wi).pdf; }
  EvalPdf evaluate(const Vec3& wi) const;  // eval and pdf for the price of one

  bool has_smooth() const { return has_smooth_; }
  bool guided() const { return guiding_prob_ > 0; }
  // Luminance of the radiance that the surface reflects towards wo, of the light that the cell
  // knows of: E rho / pi where there is no fit, as if diffuse. With one, f ~ F p_f and Li cos ~ E
  // p_L give
  //   E F integral(p_f p_L) = E rho Z / (2 <cos>),  F = rho / <cos>,
  // where <cos> is the mean cosine under p_f, and Z / 2 the product's integral per steradian.
  // 0 where no cell is known.
  float reflected_estimate() const {
    return irradiance_ * reflected_per_irradiance_ * luminance(resolved_.bsdf.mean_reflectance());
  }
  const ResolvedBsdf& resolved() const { return resolved_; }

 private:
  void prepare_guide(const GuidingCaches& caches, DirectionGuide guide, const SurfacePoint& at,
                     const Vec3& wo);
  bool prepare_product(const GuidingCaches& caches, const SurfacePoint& at);
  std::optional<Vec3> sample_guide(float u, const Vec2& u2) const;
  float guide_pdf(const Vec3& wi) const;
  float density(float bsdf_pdf, const Vec3& wi) const;
  std::optional<DirectionSample> weighted(const Vec3& wi, const Vec3& local, const EvalPdf& bsdf,
                                          float eta) const;
  std::optional<DirectionSample> sample_smooth(float u, float u_lobe, const Vec2& u2) const;
  std::optional<DirectionSample> sample_delta(float u) const;
  bool same_side(const Vec3& wi, const Vec3& wi_local) const;

  ResolvedBsdf resolved_;
  Vec3 ng_, wo_local_;
  float ng_side_;  // -1 where the shading frame was flipped against ng, else 1
  bool has_smooth_ = false;
  float delta_prob_ = 0;
  float guiding_prob_ = 0;
  float irradiance_ = 0;                     // of the cell; 0 where none is known
  float reflected_per_irradiance_ = kInvPi;  // of a surface with albedo 1
  Frame cell_frame_;
  GaussianMixture light_;
  GaussianMixture brdf_;
  std::optional<GaussianProduct> product_;
};

}  // namespace waylight
