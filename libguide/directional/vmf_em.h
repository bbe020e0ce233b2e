#pragma once
// Weighted and stepwise maximum-a-posteriori EM for von Mises-Fisher mixtures.

#include <span>
#include <vector>

#include "libguide/directional/em_batch.h"
#include "libguide/records/vmf.h"

namespace waylight {

// Conjugate priors: Dirichlet(v) on weights; on each lobe, `strength` pseudo-samples about its own
// mean with the mean resultant length `length` (0: uniform). With n samples in all, the mode is
//   weight = (n s0 + v - 1) / (n + K (v - 1)),  mean = s1 / |s1|,
//   A(kappa) = (n |s1| + strength length) / (n s0 + strength).
// One sample gives kappa = 22, n equal ones about 20 n. The defaults are those of the least
// held-out divergence, over random mixtures of up to six lobes with kappa to 30, 300 and 3000 that
// eight lobes are fitted to from 16 to 1024 samples. Uniform pseudo-samples (length 0) of the same
// strength widen narrow lobes: from 64 samples, 0.37 nats instead of 0.29 for kappa to 3000.
struct VmfPrior {
  float v = 1.01f;        // >= 1
  float strength = 0.1f;  // >= 0; without, one sample is a lobe of kMaxKappa
  float length = 0.5f;    // in [0, 1)
};

struct WeightedDirection {
  Vec3 w;        // unit; others are left out
  float weight;  // positive, finite; others are left out
};

struct VmfEmOptions {
  int components = 8;  // 1..kMaxEmComponents
  int max_iterations = 32;
  float tolerance = 1e-4f;  // relative change of the log-likelihood at which it stops
  float max_weight = kMaxTrainingWeight;
  VmfPrior prior;
};

struct VmfEmResult {
  std::vector<VmfComponent> components;  // those with support only; empty when no valid direction
  double log_likelihood = 0;             // mean by weight, natural logarithm
  int iterations = 0;
};

// Batch EM from the given start (or from initial_vmf_components when `start` is empty).
VmfEmResult fit_vmf_mixture(std::span<const WeightedDirection> points, const VmfEmOptions& options,
                            std::span<const VmfComponent> start = {});

// A start for EM: at most `count` distinct directions by spherical k-means++ with quasi-random
// numbers, three rounds of spherical k-means, and the lobes of the clusters under the prior.
// Deterministic.
std::vector<VmfComponent> initial_vmf_components(std::span<const WeightedDirection> points,
                                                 int count, const VmfPrior& prior);

// Stepwise EM without allocation: one E-step over the batch, then the M-step. `components` and
// `statistics` have the same length of at most kMaxEmComponents (statistics all zero before the
// first update); those that keep support, n s0 >= 1e-3, are moved to the front and counted in the
// result. Statistics are kept normalised (sum of s0 = 1) and decayed by eta_i = (i + 1)^-0.7.
// step: updates made so far, advanced by one unless no direction of the batch is valid.
// samples: effective number of samples that the statistics stand for; it scales the prior.
StepwiseResult stepwise_vmf_update(std::span<VmfComponent> components,
                                   std::span<VmfStatistics> statistics, float& step,
                                   std::span<const WeightedDirection> batch, float samples,
                                   const VmfPrior& prior);

// The statistics whose maximum-likelihood M-step gives a lobe.
VmfStatistics statistics_of(const VmfComponent& component);

// EM only ever loses components. Splits those that spread their mass most, weight times 1 -
// A(kappa), until there are `wanted`; the arrays have that much room. Each split keeps weight and
// resultant of the two together: the halves have three quarters of the dispersion 1 - A and stand
// apart by as much as that leaves. Returns the count.
int grow_vmf_mixture(std::span<VmfComponent> components, std::span<VmfStatistics> statistics,
                     int count, int wanted);

}  // namespace waylight
