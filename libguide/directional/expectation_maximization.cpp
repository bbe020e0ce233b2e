#include "libguide/directional/expectation_maximization.h"

#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

std::vector<GaussianComponent> start_of(std::span<const WeightedPoint> points,
                                        const EmOptions& options,
                                        std::span<const GaussianComponent> start) {
  if (start.empty()) return initial_components(points, options.components, options.prior);
  return {start.begin(), start.begin() + std::min<size_t>(start.size(), kLanes)};
}

}  // namespace

EmResult fit_mixture(std::span<const WeightedPoint> points, const EmOptions& options,
                     std::span<const GaussianComponent> start) {
  EmResult result;
  const BatchWeights weights = scan_weights(points, options.max_weight);
  result.rejected = weights.rejected;
  if (weights.used == 0) return result;
  result.components = start_of(points, options, start);
  double previous = -std::numeric_limits<double>::infinity();
  while (result.iterations < options.max_iterations) {
    BatchStatistics batch = expectation(points, weights, result.components, Likelihood::sum);
    const std::span<ComponentStatistics> statistics(batch.components.data(),
                                                    result.components.size());
    result.components.resize(
        maximization(statistics, weights.effective, options.prior, result.components));
    result.log_likelihood = batch.log_likelihood;
    ++result.iterations;
    if (batch.log_likelihood - previous < options.tolerance * std::abs(batch.log_likelihood)) break;
    previous = batch.log_likelihood;
  }
  return result;
}

StepwiseResult stepwise_update(std::span<GaussianComponent> components,
                               std::span<ComponentStatistics> statistics, float& step,
                               std::span<const WeightedPoint> batch, float samples,
                               const MixturePrior& prior, float max_weight) {
  const BatchWeights weights = scan_weights(batch, max_weight);
  const int count = static_cast<int>(components.size());
  if (weights.used == 0) return {count, weights.rejected};
  const BatchStatistics seen = expectation(batch, weights, components, Likelihood::skip);
  const float eta = std::pow(step + 1, -0.7f);
  for (int k = 0; k < count; ++k)
    statistics[k] = blend(statistics[k], 1 - eta, seen.components[k], eta);
  step += 1;
  return {maximization(statistics, samples, prior, components), weights.rejected};
}

}  // namespace waylight
