#include "libguide/guiding/phase_sampler.h"

namespace waylight {

PhaseSampler::PhaseSampler(const PhaseFunction& phase, const Vec3& wo, const Vec3& position,
                           const MediumGuide* guide, const PhaseLobes* lobes,
                           const PhaseOptions& options)
    : PhaseSampler(phase, wo) {
  if (!guide || !guide->known()) return;
  guide_ = guide;
  lobes_ = lobes;
  if (guide->focused()) seen_ = guide->focused()->seen_from(position);
  if (options.guide != PhaseGuide::none) prepare(options);
}

void PhaseSampler::prepare(const PhaseOptions& options) {
  const bool mixes = options.guide == PhaseGuide::mixture;
  const float share =
      mixes ? std::max(options.phase_share, guide_->phase_narrowness()) : options.phase_share;
  phase_share_ = 1 - guide_->trust() * (1 - share);
  if (mixes) return;
  about_forward_ = lobes_->about(forward_);
  product_.emplace(about_forward_, light());
  if (!product_->valid()) phase_share_ = 1;
}

float PhaseSampler::reflected_estimate() const {
  if (!guide_) return 0;
  return seen_ ? guide_->scattered_indirect(*seen_, *lobes_, forward_)
               : guide_->scattered_indirect(forward_);
}

EvalPdf PhaseSampler::evaluate(const Vec3& wi) const {
  const float value = phase_pdf(phase_, forward_, wi);
  if (!guided()) return {Color::Constant(value), value};
  return {Color::Constant(value), phase_share_ * value + (1 - phase_share_) * guide_pdf(wi)};
}

std::optional<DirectionSample> PhaseSampler::sample(Sampler& sampler) const {
  const float u = sampler.next(), u_lobe = sampler.next();
  const Vec2 u2 = sampler.next_2d();
  DirectionSample s;
  if (u < phase_share_)
    s.wi = sample_phase(phase_, forward_, u2);
  else
    s.wi = product_ ? product_->sample(u_lobe, u2) : light().sample(u_lobe, u2);
  const EvalPdf e = evaluate(s.wi);
  if (!(e.pdf > 0)) return std::nullopt;
  s.weight = e.value / e.pdf;
  s.pdf = e.pdf;
  s.bsdf_weight = Color::Ones();
  return s;
}

}  // namespace waylight
