#include "libguide/directional/expectation_maximization.h"

#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

std::vector<GaussianComponent> start_of(std::span<const WeightedPoint> points,
                                        const EmOptions& options,
                                        std::span<const GaussianComponent> start) {
  if (start.empty()) return initial_components(points, options.components, options.prior);
  return {start.begin(), start.begin() + std::min<size_t>(start.size(), kMaxEmComponents)};
}

// Row by row through a small buffer: a batch of any length without allocation.
BatchStatistics statistics_of(std::span<const WeightedPoint> batch, const BatchWeights& weights,
                              std::span<const GaussianComponent> components) {
  constexpr size_t kRows = 16;
  PointRow rows[kRows];
  Expectation expectation(components, Likelihood::skip);
  for (size_t begin = 0; begin < batch.size(); begin += kRows * kLanes) {
    const std::span points = batch.subspan(begin, std::min(kRows * kLanes, batch.size() - begin));
    const std::span filled = std::span(rows).first(row_count(points.size()));
    fill_rows(points, weights, filled);
    expectation.add(filled);
  }
  return expectation.finish();
}

// What the start has to say in each M-step. Once a component is lost the others have moved, and it
// has nothing to say any more.
class StartStatistics {
 public:
  StartStatistics(std::span<const GaussianComponent> start, float share) : share_(share) {
    if (share_ > 0)
      for (const GaussianComponent& c : start) statistics_.push_back(waylight::statistics_of(c));
  }
  void blend_into(std::span<ComponentStatistics> statistics) const {
    if (statistics.size() != statistics_.size()) return;
    for (size_t k = 0; k < statistics.size(); ++k)
      statistics[k] = blend(statistics[k], 1 - share_, statistics_[k], share_);
  }

 private:
  float share_;
  std::vector<ComponentStatistics> statistics_;
};

}  // namespace

ComponentStatistics statistics_of(const GaussianComponent& c) {
  return {c.weight,
          c.weight * c.mean_x,
          c.weight * c.mean_y,
          c.weight * c.cov_xx,
          c.weight * c.cov_xy,
          c.weight * c.cov_yy};
}

EmResult fit_mixture(std::span<const WeightedPoint> points, const EmOptions& options,
                     std::span<const GaussianComponent> start) {
  EmResult result;
  const BatchWeights weights = scan_weights(points, options.max_weight);
  if (weights.used == 0) return result;
  result.components = start_of(points, options, start);
  const StartStatistics start_statistics(result.components, options.start_share);
  std::vector<PointRow> rows(row_count(points.size()));
  fill_rows(points, weights, rows);
  double previous = -std::numeric_limits<double>::infinity();
  std::vector<GaussianComponent> before;
  for (;;) {
    before = result.components;
    Expectation expectation(result.components, Likelihood::sum);
    expectation.add(rows);
    BatchStatistics batch = expectation.finish();
    const std::span<ComponentStatistics> statistics(batch.components.data(),
                                                    result.components.size());
    start_statistics.blend_into(statistics);
    result.components.resize(
        maximization(statistics, weights.effective, options.prior, result.components));
    result.log_likelihood = batch.log_likelihood;
    if (++result.iterations >= options.max_iterations) break;
    const double gain = batch.log_likelihood - previous;
    const bool overshot = options.step > 1 && gain < 0;  // a plain step comes next
    if (!overshot && gain < options.tolerance * std::abs(batch.log_likelihood)) break;
    previous = batch.log_likelihood;
    if (options.step > 1 && !overshot) over_relax(before, options.step, result.components);
  }
  return result;
}

StepwiseResult stepwise_update(std::span<GaussianComponent> components,
                               std::span<ComponentStatistics> statistics, float& step,
                               std::span<const WeightedPoint> batch, float samples,
                               const MixturePrior& prior) {
  const BatchWeights weights = scan_weights(batch, kMaxTrainingWeight);
  const int count = static_cast<int>(components.size());
  if (weights.used == 0) return {count};
  const BatchStatistics seen = statistics_of(batch, weights, components);
  const float eta = std::pow(step + 1, -0.7f);
  for (int k = 0; k < count; ++k)
    statistics[k] = blend(statistics[k], 1 - eta, seen.components[k], eta);
  step += 1;
  return {maximization(statistics, samples, prior, components)};
}

}  // namespace waylight
