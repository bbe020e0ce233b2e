#pragma once
// What the EMs of all mixtures share: how a batch is weighted, and how the E-step shares it out.

#include <span>

#include "libguide/math/fast_exp.h"
#include "libguide/math/fast_log.h"
#include "libguide/math/types.h"

namespace waylight {

// In training only: no sample weighs more than this many times the mean weight of its batch (after
// capping), nor more than all others of the batch together. Energy that is carried by more than one
// sample in 32 is left alone; a firefly is bounded.
inline constexpr float kMaxTrainingWeight = 32;

// More than a mixture for sampling holds: fits may begin with more and be reduced.
inline constexpr int kMaxEmComponents = 16;

// Components without n s0 >= kMinSupport are dropped.
inline constexpr float kMinSupport = 1e-3f;  // of a sample

// Components with support are moved to the front and counted.
struct StepwiseResult {
  int count = 0;
};

// How the weights of a batch are to be read.
struct BatchWeights {
  int used = 0;         // points of a positive weight
  float cap = 0;        // weights are cut here
  float scale = 0;      // 1 / the mean of the cut positive weights
  float effective = 0;  // (sum w)^2 / sum w^2 of the cut weights
};

struct CutSums {
  double sum = 0, squares = 0;
};

// Calls weight_of(i) for each sample: its weight, positive and finite; 0 where it does not count.
template <typename WeightOf>
CutSums cut_sums(size_t count, const WeightOf& weight_of, double cap) {
  CutSums result;
  for (size_t i = 0; i < count; ++i) {
    const float weight = weight_of(i);
    if (!(weight > 0)) continue;
    const double w = std::min<double>(weight, cap);
    result.sum += w, result.squares += w * w;
  }
  return result;
}

template <typename WeightOf>
BatchWeights scan_weights(size_t count, const WeightOf& weight_of, float max_weight) {
  BatchWeights result;
  float largest = 0;
  for (size_t i = 0; i < count; ++i) {
    const float weight = weight_of(i);
    result.used += weight > 0;
    largest = std::max(largest, weight);
  }
  if (result.used == 0) return result;
  // The cap is a fixed point, cap = ratio * mean(min(w, cap)), sought from above: each round takes
  // an outlier down by the factor ratio / n <= 1/2.
  const double ratio = std::max(1.0, std::min<double>(max_weight, 0.5 * result.used));
  CutSums sums = cut_sums(count, weight_of, largest);
  double cap = largest;
  for (int round = 0; round < 128 && ratio * sums.sum < 0.999 * cap * result.used; ++round) {
    cap = ratio * sums.sum / result.used;
    sums = cut_sums(count, weight_of, cap);
  }
  result.cap = static_cast<float>(cap);
  result.scale = static_cast<float>(result.used / sums.sum);
  result.effective = static_cast<float>(sums.sum * sums.sum / sums.squares);
  return result;
}

// Rows of eight samples, so that no sum runs across lanes before the end.
inline size_t row_count(size_t points) { return (points + kLanes - 1) / kLanes; }

// Rows whose responsibilities fit the first-level cache of the processor, and that are summed in
// float before they go into doubles.
inline constexpr size_t kBlockRows = 16;
using BlockLanes = Lanes[kBlockRows];
using Shares = BlockLanes[kMaxEmComponents];  // responsibility times weight

enum class Likelihood { skip, sum };

// Component by component, rows inside: what rows do does not depend on each other, so the processor
// need not wait for one to be done with another.
template <typename Row, typename Model>
void log2_densities(std::span<const Row> rows, std::span<const Model> model, Shares& densities,
                    BlockLanes& largest) {
  for (size_t r = 0; r < rows.size(); ++r) largest[r] = splat(-1e30f);
  for (size_t k = 0; k < model.size(); ++k)
    for (size_t r = 0; r < rows.size(); ++r) {
      densities[k][r] = model[k].log2_density(rows[r]);
      largest[r] = lanes_max(largest[r], densities[k][r]);
    }
}

// model[k].log2_density(row) is log2 of weight times density. Subtracting the largest before the
// exponential keeps a point far from all lobes with the nearest one. Returns the weighted sum of
// log2 of the mixture's density if asked for.
template <Likelihood likelihood, typename Row, typename Model>
double share_out(std::span<const Row> rows, std::span<const Model> model, Shares& shares) {
  const size_t count = rows.size();
  BlockLanes largest, sum, scale;
  log2_densities(rows, model, shares, largest);
  for (size_t r = 0; r < count; ++r) sum[r] = Lanes{};
  for (size_t k = 0; k < model.size(); ++k)
    for (size_t r = 0; r < count; ++r)
      sum[r] += shares[k][r] = exp2_clamped(shares[k][r] - largest[r]);
  for (size_t r = 0; r < count; ++r) scale[r] = rows[r].weight / sum[r];
  for (size_t k = 0; k < model.size(); ++k)
    for (size_t r = 0; r < count; ++r) shares[k][r] *= scale[r];
  Lanes log2_likelihood{};
  if constexpr (likelihood == Likelihood::sum)
    for (size_t r = 0; r < count; ++r)
      log2_likelihood += rows[r].weight * (largest[r] + lanes_log2(sum[r]));
  return lanes_sum(log2_likelihood);
}

}  // namespace waylight
