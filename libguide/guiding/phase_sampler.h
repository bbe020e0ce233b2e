#pragma once
// The directional decision of one vertex in a medium: phase function or guide.

#include <algorithm>

#include "libguide/directional/vmf_product.h"
#include "libguide/guiding/direction_sampler.h"
#include "libguide/guiding/medium_guides.h"
#include "libguide/medium/phase.h"

namespace waylight {

// What is sampled beside the phase function: incident light, or its product with the phase
// function's lobes [Herholz et al. 2019].
enum class PhaseGuide { none, mixture, product };

struct PhaseOptions {
  PhaseGuide guide = PhaseGuide::none;
  float phase_share = 0.25f;  // of sampling the phase function where there is a guide, in (0, 1]

  // The same, with half or more for the phase function in grids. Cells are coarse for what is in
  // them: with a quarter, a few bright paths are half of the noise of a thin cloud. It gains a
  // tenth in dense ones.
  PhaseOptions for_medium(bool homogeneous) const {
    constexpr float kShareInGrids = 0.5f;
    return {guide, homogeneous ? phase_share : std::max(phase_share, kShareInGrids)};
  }
};

// The counterpart of DirectionSampler: the same questions, so that the path loop need not know
// where a vertex is. The density is
//   p(wi) = a f(wi) + (1 - a) p_guide(wi),
// one-sample MIS with the share of the phase function raised where the cell's evidence is poor, and
// for the guide `mixture` where the phase function is narrower than the light: samples of the light
// would leave its peak to weigh 1 / a at every scattering. The albedo is not in it: the weight of
// the flight that ended here has it.
class PhaseSampler {
 public:
  // The phase function alone.
  PhaseSampler(const PhaseFunction& phase, const Vec3& wo) : phase_(phase), forward_(-wo) {}
  // guide: of the cell of `position`, null where there is none; lobes: of the phase function.
  PhaseSampler(const PhaseFunction& phase, const Vec3& wo, const Vec3& position,
               const MediumGuide* guide, const PhaseLobes* lobes, const PhaseOptions& options);
  PhaseSampler(const PhaseSampler&) = delete;
  PhaseSampler& operator=(const PhaseSampler&) = delete;

  Color eval(const Vec3& wi) const { return evaluate(wi).value; }
  std::optional<DirectionSample> sample(Sampler& sampler) const;
  float pdf(const Vec3& wi) const { return evaluate(wi).pdf; }
  EvalPdf evaluate(const Vec3& wi) const;

  bool has_smooth() const { return true; }
  float delta_prob() const { return 0; }
  bool guided() const { return phase_share_ < 1; }
  float bsdf_share() const { return phase_share_; }
  // Luminance of the radiance scattered towards wo, of indirect light, before the albedo; 0 where
  // the cell knows too little.
  float reflected_estimate() const;

 private:
  const VmfMixture& light() const { return seen_ ? *seen_ : guide_->indirect(); }
  void prepare(const PhaseOptions& options);
  float guide_pdf(const Vec3& wi) const { return product_ ? product_->pdf(wi) : light().pdf(wi); }

  const PhaseFunction& phase_;
  Vec3 forward_;                        // -wo
  const MediumGuide* guide_ = nullptr;  // where it is known
  const PhaseLobes* lobes_ = nullptr;
  std::optional<VmfMixture> seen_;  // by lobes that point to places
  float phase_share_ = 1;
  VmfMixture about_forward_;
  std::optional<VmfProduct> product_;
};

}  // namespace waylight
