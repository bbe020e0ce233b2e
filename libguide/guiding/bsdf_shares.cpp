#include "libguide/guiding/bsdf_shares.h"

#include <algorithm>
#include <cmath>

namespace waylight {

void ShareLearner::add(const GuidedSample& s) {
  const double square = double(s.contribution) * s.contribution, weight = square * s.pdf;
  if (!(weight > 0) || !std::isfinite(weight * weight)) return;
  const auto moment = [&](double share) {
    return weight / (share * s.bsdf_pdf + (1 - share) * s.guide_pdf);
  };
  // A direction that BSDF sampling never makes carries nothing.
  if (!(s.bsdf_pdf > 0)) return;
  Evidence& evidence = evidence_[s.cell];
  for (size_t i = 0; i < kGrid.size(); ++i) evidence.moment[i] += moment(kGrid[i]);
  evidence.default_moment += moment(default_share_);
  evidence.squares += square;
  evidence.fourth_powers += square * square;
}

ShareLearner::Common ShareLearner::common() const {
  Evidence sum;
  double samples = 0;
  for (const Evidence& evidence : evidence_) {
    for (size_t i = 0; i < kGrid.size(); ++i) sum.moment[i] += evidence.moment[i];
    sum.default_moment += evidence.default_moment;
    sum.squares += evidence.squares;
    sum.fourth_powers += evidence.fourth_powers;
    samples += evidence.samples();
  }
  Common common;
  common.mean_square = samples > 0 ? sum.squares / samples : 0;
  const double n = sum.samples();
  for (size_t i = 0; i < kGrid.size(); ++i) {
    const double distance = double(kGrid[i]) - default_share_;
    const double prior = kPriorSamples * (1 + kPriorCurvature * distance * distance);
    const double evidence = n > 0 ? n * sum.moment[i] / sum.default_moment : 0;
    common.ratio[i] = (evidence + prior) / (n + kPriorSamples);
  }
  return common;
}

float ShareLearner::best_share(const Evidence& evidence, const Common& common) const {
  const double samples = evidence.squares > 0
                             ? std::min(evidence.samples(), evidence.squares / common.mean_square)
                             : 0;
  float best = default_share_;
  double least = samples + kPriorSamples;  // of the default itself
  for (size_t i = 0; i < kGrid.size(); ++i) {
    const double ratio = samples > 0 ? evidence.moment[i] / evidence.default_moment : 0;
    const double cost = samples * ratio + kPriorSamples * common.ratio[i];
    if (cost < least) least = cost, best = kGrid[i];
  }
  return best;
}

std::vector<float> ShareLearner::shares() const {
  const Common all = common();
  std::vector<float> shares;
  shares.reserve(evidence_.size());
  for (const Evidence& evidence : evidence_) shares.push_back(best_share(evidence, all));
  return shares;
}

}  // namespace waylight
