#include "libguide/guiding/phase_sampler.h"

namespace waylight {

PhaseSampler::PhaseSampler(const PhaseFunction& phase, const Vec3& wo, const MediumGuide* guide,
                           const PhaseLobes* lobes, const PhaseOptions& options)
    : phase_(phase), forward_(-wo), guide_(guide) {
  if (options.guide != PhaseGuide::none && guide && guide->known()) prepare(*lobes, options);
}

void PhaseSampler::prepare(const PhaseLobes& lobes, const PhaseOptions& options) {
  phase_share_ = 1 - guide_->trust() * (1 - options.phase_share);
  if (options.guide != PhaseGuide::product) return;
  about_forward_ = lobes.about(forward_);
  product_.emplace(about_forward_, guide_->indirect());
  if (!product_->valid()) phase_share_ = 1;
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
    s.wi = product_ ? product_->sample(u_lobe, u2) : guide_->indirect().sample(u_lobe, u2);
  const EvalPdf e = evaluate(s.wi);
  if (!(e.pdf > 0)) return std::nullopt;
  s.weight = e.value / e.pdf;
  s.pdf = e.pdf;
  s.bsdf_weight = Color::Ones();
  return s;
}

}  // namespace waylight
