#include "libguide/guiding/cell_choices.h"

#include <algorithm>
#include <cmath>

namespace waylight {
namespace {

// Of a vertex over one left to the BSDF, next-event estimation included, in rays of the path loop
// with their shading (0.7 us).
constexpr double kPriceOfLight = 0.3, kPriceOfProduct = 0.7;

}  // namespace

void CellChoiceLearner::Evidence::merge(const Evidence& other) {
  for (size_t g = 0; g < moment.size(); ++g)
    for (size_t i = 0; i < kGrid.size(); ++i) moment[g][i] += other.moment[g][i];
  default_moment += other.default_moment;
  squares += other.squares;
  fourth_powers += other.fourth_powers;
  visits += other.visits;
}

void CellChoiceLearner::add(const GuidedSample& s) {
  const double square = double(s.contribution) * s.contribution, weight = square * s.pdf;
  Evidence& evidence = evidence_[s.cell];
  ++evidence.visits;
  if (!(weight > 0) || !std::isfinite(weight * weight)) return;
  // A direction that BSDF sampling never makes carries nothing.
  if (!(s.bsdf_pdf > 0)) return;
  const auto moment = [&](size_t guide, double share) {
    return weight / (share * s.bsdf_pdf + (1 - share) * s.guide_pdfs[guide]);
  };
  for (size_t g = 0; g < guides_.size(); ++g)
    for (size_t i = 0; i < kGrid.size(); ++i) evidence.moment[g][i] += moment(g, kGrid[i]);
  evidence.default_moment += moment(guides_.size() - 1, default_share_);
  evidence.squares += square;
  evidence.fourth_powers += square * square;
}

CellChoiceLearner::Common CellChoiceLearner::common() const {
  Evidence sum;
  double samples = 0;
  for (const Evidence& evidence : evidence_) {
    sum.merge(evidence);
    samples += evidence.samples();
  }
  Common common;
  common.mean_square = samples > 0 ? sum.squares / samples : 0;
  common.mean_moment = sum.visits > 0 ? sum.default_moment / sum.visits : 0;
  const double n = sum.samples();
  for (size_t g = 0; g < guides_.size(); ++g)
    for (size_t i = 0; i < kGrid.size(); ++i) {
      const double distance = double(kGrid[i]) - default_share_;
      const double prior = kPriorSamples * (1 + kPriorCurvature * distance * distance);
      const double evidence = n > 0 ? n * sum.moment[g][i] / sum.default_moment : 0;
      common.ratio[g][i] = (evidence + prior) / (n + kPriorSamples);
    }
  return common;
}

double CellChoiceLearner::price(size_t guide, float share) const {
  if (!(work_ > 0) || share == 1) return 0;
  return guides_[guide] == DirectionGuide::illumination ? kPriceOfLight : kPriceOfProduct;
}

CellChoice CellChoiceLearner::choose(const Evidence& evidence, const Common& common) const {
  const double n = evidence.squares > 0
                       ? std::min(evidence.samples(), evidence.squares / common.mean_square)
                       : 0;
  const bool priced = work_ > 0 && variance_ > 0;
  // Of a visit, held to what visits of all cells are worth.
  const double default_moment = (evidence.default_moment + kPriorSamples * common.mean_moment) /
                                (evidence.visits + kPriorSamples);
  const auto cost = [&](double ratio, double price) {
    return priced ? default_moment * ratio / variance_ + price / work_ : ratio;
  };
  const size_t last = guides_.size() - 1;
  CellChoice best{guides_[last], default_share_};
  double least = cost(1, price(last, default_share_));
  for (size_t g = 0; g < guides_.size(); ++g)
    for (size_t i = 0; i < kGrid.size(); ++i) {
      const double own = n > 0 ? n * evidence.moment[g][i] / evidence.default_moment : 0;
      const double ratio = (own + kPriorSamples * common.ratio[g][i]) / (n + kPriorSamples);
      const double expected = cost(ratio, price(g, kGrid[i]));
      if (expected < least) least = expected, best = {guides_[g], kGrid[i]};
    }
  if (best.bsdf_share == 1) best.guide = DirectionGuide::none;
  return best;
}

std::vector<CellChoice> CellChoiceLearner::choices() const {
  const Common all = common();
  std::vector<CellChoice> choices;
  choices.reserve(evidence_.size());
  for (const Evidence& evidence : evidence_) choices.push_back(choose(evidence, all));
  return choices;
}

}  // namespace waylight
