#pragma once
// The directional decision of one path vertex: delta lobe, BSDF or guide.

#include <optional>

#include "libguide/base/sampler.h"
#include "libguide/guiding/cell_guide.h"
#include "libguide/guiding/guiding_caches.h"
#include "libguide/scene/scene.h"

namespace waylight {

struct DirectionOptions {
  DirectionGuide guide = DirectionGuide::none;
  float bsdf_share = 0.5f;  // of smooth scattering where there is a guide, in (0, 1]
  int candidates = 2;       // of `resampled`, in [1, 64]
  bool learned = false;  // guide and share of a cell are those learned for it, where there are any
  bool light_alone = false;  // no product, whatever was learned
  bool compares = false;     // samples tell light_pdf
  bool estimates = false;    // reflected_estimate() is asked for, also without a guide
};

struct DirectionSample {
  Vec3 wi;        // world space
  Color weight;   // f |cos| / pdf of everything chosen here
  float pdf = 0;  // of the smooth part, per steradian, the chance of choosing it included
  bool is_delta = false;
  float eta = 1;
  Color bsdf_weight;  // the weight that BSDF sampling would have given; drives Russian roulette
  // Given the smooth part, per steradian: of BSDF sampling, and of what share 0 of it would leave.
  float bsdf_pdf = 0, guide_pdf = 0;
  float light_pdf = 0;    // as guide_pdf, if the guide were the light alone; where asked for
  bool straight = false;  // through a pane: no vertex of the path
};

// Density over the smooth part:
//   p(wi) = (1 - P_delta) [a p_bsdf(wi) + (1 - a) p_guide(wi)],
// one-sample MIS with a the share of BSDF sampling where a guide is at hand and 1 elsewhere, so the
// density is positive wherever the BSDF's own is. p_guide is a sub-density: what falls below the
// horizon or outside the plane, or where f is zero, is a sample of value zero. No such sample is
// returned, and the density is zero there.
//
// `resampled` draws its candidates from that p with the illumination guide and keeps one of them
// [Talbot et al. 2005] (resampling.cpp). It has no density in closed form: pdf and the weights of
// MIS with next-event estimation use p in its stead, on both sides, so they still sum to one.
//
// At surfaces that transmit (rough glass) the guide is a mixture of the cells of both sides.
class DirectionSampler {
 public:
  DirectionSampler(const Scene& scene, const GuidingCaches& caches, const DirectionOptions& options,
                   const SurfacePoint& at, const Vec3& wo,
                   TransportMode mode = TransportMode::radiance);
  DirectionSampler(const DirectionSampler&) = delete;
  DirectionSampler& operator=(const DirectionSampler&) = delete;

  // f(wo, wi) |cos wi| of the smooth part; zero where geometric and shading side disagree.
  Color eval(const Vec3& wi) const { return evaluate(wi).value; }
  std::optional<DirectionSample> sample(Sampler& sampler) const;
  float pdf(const Vec3& wi) const { return evaluate(wi).pdf; }
  EvalPdf evaluate(const Vec3& wi) const;  // eval and pdf for the price of one

  bool has_smooth() const { return has_smooth_; }
  float delta_prob() const { return delta_prob_; }  // of one of the delta lobes
  bool guided() const { return bsdf_share_ < 1; }
  // Whether geometric and shading normal agree on the side that wi is on.
  bool same_side(const Vec3& wi) const { return same_side(wi, resolved_.frame.to_local(wi)); }
  float bsdf_share() const { return bsdf_share_; }
  const CacheCell* cell() const {  // whose share of BSDF sampling holds; null where none is known
    return near_ ? &near_->cell() : far_ ? &far_->cell() : nullptr;
  }
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
  struct Candidate;

  void prepare_guide(const GuidingCaches& caches, const SurfacePoint& at, const Vec3& normal);
  float prepare_sides(const GuidingCaches& caches, const SurfacePoint& at, const Vec3& normal);
  void estimate(const GuidingCaches& caches, const SurfacePoint& at, const Vec3& normal);
  const CacheCell* choose(const GuidingCaches& caches, const CacheCell* cell);
  float prepare_fit(const GuidingCaches& caches, const SurfacePoint& at);
  std::optional<Vec3> sample_guide(float u, const Vec2& u2) const;
  float guide_pdf(const Vec3& wi) const;
  float light_pdf(const Candidate& candidate) const;
  float density(float bsdf_pdf, float guide_pdf) const;
  std::optional<DirectionSample> sample_delta(float u) const;
  std::optional<Candidate> sample_smooth(float u, float u_lobe, const Vec2& u2) const;
  std::optional<Candidate> candidate(const Vec3& wi, const Vec3& local, const EvalPdf& bsdf,
                                     float eta) const;
  DirectionSample finish(const Candidate& candidate) const;
  std::optional<DirectionSample> resample(float u, Sampler& sampler) const;
  bool same_side(const Vec3& wi, const Vec3& wi_local) const;

  DirectionOptions options_;  // guide and share as they are here
  uint32_t here_;  // the cell on the side of wo; located first, since it takes long to be read
  ResolvedBsdf resolved_;
  Vec3 ng_, wo_local_;
  float ng_side_;  // -1 where the shading frame was flipped against ng, else 1
  bool has_smooth_ = false;
  float delta_prob_ = 0;
  float known_ = 1;                          // share of the BSDF that the guide is for
  float guided_ = 0;                         // of scattering, by the guide where a is 0
  float bsdf_share_ = 1;                     // 1 - guided (1 - a)
  float irradiance_ = 0;                     // of the cell; 0 where none is known
  float reflected_per_irradiance_ = kInvPi;  // of a surface with albedo 1
  std::optional<CellGuide> near_, far_;      // on the side of wo; behind a surface that transmits
  float near_prob_ = 1;                      // of the guide
};

// A direction of the smooth part with all that can be told of it.
struct DirectionSampler::Candidate {
  Vec3 wi;
  EvalPdf bsdf;  // value, and density of BSDF sampling given the smooth part
  float cos;     // |cos| to the shading normal
  float guide_pdf, pdf;
  float eta;
};

}  // namespace waylight
