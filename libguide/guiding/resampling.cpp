// Resampled importance sampling of one vertex's direction.

#include "libguide/guiding/direction_sampler.h"

namespace waylight {
namespace {

// Share of the target that takes light to be equal from all around. A target that follows the cell
// alone is all but zero where the cell knows of no light, and what comes from there would be found
// rarely and weigh much.
constexpr float kDefensiveShare = 0.2f;

}  // namespace

// Candidates y_i, i < N, from p; one kept in proportion to w_i = q(y_i) / p(y_i) with the target
//   q = f (p_guide (1 - d) + d cos / pi),
// f the luminance of the true BSDF without its cosine, which p_guide ~ Li cos has already. Its
// weight f cos / q * sum w_i / N is unbiased [Talbot et al. 2005]. The N choices between BSDF and
// guide share one stratified random number, so that their shares are kept as exactly as N allows.
std::optional<DirectionSample> DirectionSampler::resample(float u_technique,
                                                          Sampler& sampler) const {
  float u_choice = sampler.next(), sum = 0, kept_target = 0;
  std::optional<Candidate> kept;
  for (int i = 0; i < options_.candidates; ++i) {
    const float u = std::min((i + u_technique) / options_.candidates, kOneMinusEpsilon);
    const float u_lobe = sampler.next();
    const std::optional<Candidate> c = sample_smooth(u, u_lobe, sampler.next_2d());
    if (!c) continue;
    const float light = (1 - kDefensiveShare) * c->guide_pdf / std::max(c->cos, 1e-6f);
    const float target = luminance(c->bsdf.value) * (light + kDefensiveShare * kInvPi);
    const float weight = target / c->pdf;
    if (!(weight > 0) || !std::isfinite(weight)) continue;
    sum += weight;
    const float prob = weight / sum;
    if (u_choice < prob) {
      kept = c, kept_target = target;
      u_choice /= prob;
    } else {
      u_choice = (u_choice - prob) / (1 - prob);
    }
  }
  if (!kept) return std::nullopt;
  DirectionSample result = finish(*kept);
  result.weight = kept->bsdf.value * (sum / (options_.candidates * kept_target));
  return result;
}

}  // namespace waylight
