#include "libguide/directional/vmf_em.h"

#include "libguide/directional/vmf_em_step.h"

namespace waylight {
namespace {

std::vector<VmfComponent> start_of(std::span<const WeightedDirection> points,
                                   const VmfEmOptions& options,
                                   std::span<const VmfComponent> start) {
  if (start.empty()) return initial_vmf_components(points, options.components, options.prior);
  return {start.begin(), start.begin() + std::min<size_t>(start.size(), kMaxEmComponents)};
}

// Row by row through a small buffer: a batch of any length without allocation.
VmfBatchStatistics statistics_of(std::span<const WeightedDirection> batch,
                                 const BatchWeights& weights,
                                 std::span<const VmfComponent> components) {
  DirectionRow rows[kBlockRows];
  VmfExpectation expectation(components, Likelihood::skip);
  for (size_t begin = 0; begin < batch.size(); begin += kBlockRows * kLanes) {
    const size_t size = std::min(kBlockRows * kLanes, batch.size() - begin);
    const std::span filled = std::span(rows).first(row_count(size));
    fill_rows(batch.subspan(begin, size), weights, filled);
    expectation.add(filled);
  }
  return expectation.finish();
}

VmfStatistics blend(const VmfStatistics& a, float keep, const VmfStatistics& b, float add) {
  return {keep * a.s0 + add * b.s0, keep * a.s1 + add * b.s1};
}

}  // namespace

VmfEmResult fit_vmf_mixture(std::span<const WeightedDirection> points, const VmfEmOptions& options,
                            std::span<const VmfComponent> start) {
  VmfEmResult result;
  const BatchWeights weights = scan_weights(points, options.max_weight);
  if (weights.used == 0) return result;
  result.components = start_of(points, options, start);
  std::vector<DirectionRow> rows(row_count(points.size()));
  fill_rows(points, weights, rows);
  double previous = -std::numeric_limits<double>::infinity();
  while (result.iterations < options.max_iterations) {
    VmfExpectation expectation(result.components, Likelihood::sum);
    expectation.add(rows);
    VmfBatchStatistics batch = expectation.finish();
    const std::span statistics(batch.components.data(), result.components.size());
    result.components.resize(
        maximization(statistics, weights.effective, options.prior, result.components));
    result.log_likelihood = batch.log_likelihood;
    ++result.iterations;
    if (batch.log_likelihood - previous < options.tolerance * std::abs(batch.log_likelihood)) break;
    previous = batch.log_likelihood;
  }
  return result;
}

StepwiseResult stepwise_vmf_update(std::span<VmfComponent> components,
                                   std::span<VmfStatistics> statistics, float& step,
                                   std::span<const WeightedDirection> batch, float samples,
                                   const VmfPrior& prior) {
  const BatchWeights weights = scan_weights(batch, kMaxTrainingWeight);
  const int count = static_cast<int>(components.size());
  if (weights.used == 0) return {count};
  const VmfBatchStatistics seen = statistics_of(batch, weights, components);
  const float eta = std::pow(step + 1, -0.7f);
  for (int k = 0; k < count; ++k)
    statistics[k] = blend(statistics[k], 1 - eta, seen.components[k], eta);
  step += 1;
  return {maximization(statistics, samples, prior, components)};
}

}  // namespace waylight
