#pragma once
// The two halves of one EM iteration, shared by batch and stepwise EM.

#include <array>

#include "libguide/directional/expectation_maximization.h"

namespace waylight {

// How the weights of a batch are to be read.
struct BatchWeights {
  int used = 0, rejected = 0;  // points of weight 0 are neither
  float cap = 0;               // weights are cut here
  float scale = 0;             // 1 / the mean of the cut positive weights
  float effective = 0;         // (sum w)^2 / sum w^2 of the cut weights
};

bool valid_point(const WeightedPoint& point);
BatchWeights scan_weights(std::span<const WeightedPoint> points, float max_weight);

// Sufficient statistics of one pass over a batch, as in ComponentStatistics.
struct BatchStatistics {
  std::array<ComponentStatistics, kLanes> components;
  double log_likelihood = 0;  // mean by weight, natural logarithm; only if asked for
};

enum class Likelihood { skip, sum };
BatchStatistics expectation(std::span<const WeightedPoint> points, const BatchWeights& weights,
                            std::span<const GaussianComponent> components, Likelihood likelihood);

// keep * a + add * b of moments about their own means.
ComponentStatistics blend(const ComponentStatistics& a, float keep, const ComponentStatistics& b,
                          float add);

// Components of the statistics with n = samples (at least 1); those without support are left out of
// both, the others moved to the front. Returns how many are left.
int maximization(std::span<ComponentStatistics> statistics, float samples,
                 const MixturePrior& prior, std::span<GaussianComponent> components);

}  // namespace waylight
