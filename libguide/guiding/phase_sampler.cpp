#include "libguide/guiding/phase_sampler.h"

namespace waylight {

EvalPdf PhaseSampler::evaluate(const Vec3& wi) const {
  const float value = phase_pdf(phase_, forward_.dot(wi));
  return {Color::Constant(value), value};
}

std::optional<DirectionSample> PhaseSampler::sample(Sampler& sampler) const {
  DirectionSample result;
  result.wi = sample_phase(phase_, forward_, sampler.next_2d());
  result.pdf = result.bsdf_pdf = pdf(result.wi);
  result.weight = result.bsdf_weight = Color::Ones();
  return result;
}

}  // namespace waylight
