#pragma once
// Weighted and stepwise maximum-a-posteriori EM for Gaussian mixtures [Vorba et al. 2014].

#include <span>
#include <vector>

#include "libguide/directional/em_batch.h"
#include "libguide/directional/gaussian_mixture.h"
#include "libguide/records/guide_cache.h"

namespace waylight {

// Conjugate priors: Dirichlet(v) on weights, inverse Wishart(a, b I) on covariances. The mode that
// is taken is that of [Gauvain, Lee 1994] in d = 2 dimensions, without a prior on the means:
//   weight = (n s0 + v - 1) / (n + K (v - 1)),  mean = s1 / s0,
//   covariance = (b I + n s2) / (a - 2 + n s0),  s2 about the mean.
// A component that one sample supports has variance b / 1.01, one that nothing supports b / 0.01.
struct MixturePrior {
  float v = 1.01f, a = 2.01f, b = 5e-4f;  // v >= 1, a > 2, b > 0
};

struct WeightedPoint {
  Vec2 y;
  float weight;  // positive, finite; others are left out, and so are places off the domain
};

struct EmOptions {
  int components = 8;  // 1..kMaxEmComponents
  int max_iterations = 32;
  float step = 1;  // in [1, 2): over-relaxation, how far to go of the way that an M-step goes
  float tolerance = 1e-4f;  // relative change of the log-likelihood at which it stops
  float max_weight = kMaxTrainingWeight;
  MixturePrior prior;
  float start_share = 0;  // of the statistics of each M-step, those of the start; in [0, 1)
};

struct EmResult {
  std::vector<GaussianComponent> components;  // those with support only; empty when no valid point
  double log_likelihood = 0;                  // mean over the points by weight, natural logarithm
  int iterations = 0;
};

// Batch EM from the given start (or from initial_components of the points when `start` is empty).
EmResult fit_mixture(std::span<const WeightedPoint> points, const EmOptions& options,
                     std::span<const GaussianComponent> start = {});

// A start for EM: at most `count` distinct points by k-means++ with quasi-random numbers, three
// rounds of Lloyd's algorithm, and the covariances of the clusters under the prior. Deterministic.
std::vector<GaussianComponent> initial_components(std::span<const WeightedPoint> points, int count,
                                                  const MixturePrior& prior);

// The same with the first centres given: one round of hard assignment.
std::vector<GaussianComponent> components_around(std::span<const WeightedPoint> points,
                                                 std::span<const Vec2> centres,
                                                 const MixturePrior& prior);

// The statistics whose maximum-likelihood M-step gives a component.
ComponentStatistics statistics_of(const GaussianComponent& component);

// Stepwise EM without allocation: one E-step over the batch, then the M-step. Statistics are kept
// normalised (sum of s0 = 1) and decayed by eta_i = (i + 1)^-0.7. `components` and
// `statistics` have the same length of at most kMaxEmComponents (statistics all zero before the
// first update); those that keep support, n s0 >= 1e-3, are moved to the front and counted in the
// result.
// step: updates made so far, advanced by one unless no point of the batch is valid.
// samples: effective number of samples that the statistics stand for; it scales the prior.
StepwiseResult stepwise_update(std::span<GaussianComponent> components,
                               std::span<ComponentStatistics> statistics, float& step,
                               std::span<const WeightedPoint> batch, float samples,
                               const MixturePrior& prior);

}  // namespace waylight
