#include "libguide/math/distribution.h"

#include <bit>

namespace waylight {
namespace {

constexpr size_t kIndicesPerStep = 4, kMaxSteps = 1 << 20;

}  // namespace

Discrete::Discrete(std::span<const float> weights) : cdf_(weights.size() + 1, 0.0f) {
  for (const float w : weights) total_ += w;
  if (total_ <= 0) return;
  double sum = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    cdf_[i + 1] = static_cast<float>(sum / total_);
  }
  index();
}

void Discrete::index() {
  const size_t steps =
      std::clamp<size_t>(std::bit_ceil(cdf_.size()) / kIndicesPerStep, 1, kMaxSteps);
  steps_ = static_cast<float>(steps);
  first_.assign(steps + 1, 0);
  auto above = cdf_.begin();
  for (size_t k = 0; k <= steps; ++k) {
    while (above != cdf_.end() && *above <= static_cast<float>(k) / steps_) ++above;
    first_[k] = static_cast<uint32_t>(above - cdf_.begin()) - 1;
  }
}

// The last index whose cdf is at most u: indices of no probability are stepped over. The last entry
// is exactly one, as sum and total add the same terms in the same order.
Discrete::Sample Discrete::sample(float u) const {
  const auto step = static_cast<size_t>(u * steps_);
  const auto above =
      std::upper_bound(cdf_.begin() + first_[step], cdf_.begin() + first_[step + 1] + 1, u);
  const int index = static_cast<int>(above - cdf_.begin()) - 1;
  const float p = prob(index);
  return {index, p, std::min((u - cdf_[index]) / p, kOneMinusEpsilon)};
}

PiecewiseConstant1d::Sample PiecewiseConstant1d::sample(float u) const {
  const Discrete::Sample chosen = cells_.sample(u);
  const float x = (static_cast<float>(chosen.index) + chosen.u) / static_cast<float>(size());
  return {std::min(x, kOneMinusEpsilon), chosen.prob * static_cast<float>(size()), chosen.index,
          chosen.u};
}

PiecewiseConstant2d::PiecewiseConstant2d(std::span<const float> weights, int width, int height) {
  std::vector<float> row_weights;
  columns_.reserve(height);
  for (int y = 0; y < height; ++y) {
    columns_.emplace_back(weights.subspan(static_cast<size_t>(y) * width, width));
    row_weights.push_back(static_cast<float>(columns_.back().total()));
  }
  rows_ = PiecewiseConstant1d(row_weights);
}

PiecewiseConstant2d::Sample PiecewiseConstant2d::sample(const Vec2& u) const {
  const PiecewiseConstant1d::Sample y = rows_.sample(u.y());
  const PiecewiseConstant1d::Sample x = columns_[y.cell].sample(u.x());
  return {{x.x, y.x}, x.pdf * y.pdf, x.cell, y.cell, {x.inside, y.inside}};
}

}  // namespace waylight
