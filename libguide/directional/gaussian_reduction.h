#pragma once
// Fewer components for a mixture by greedy merging [Runnalls 2007].

#include "libguide/directional/greedy_reduction.h"
#include "libguide/records/gaussian.h"

namespace waylight {

// The one Gaussian with the weight, mean and covariance of two.
GaussianComponent merge(const GaussianComponent& i, const GaussianComponent& j);

// Runnalls' upper bound of the Kullback-Leibler discrimination of a mixture from the one with the
// two merged, B = ((w_i + w_j) ln|Sigma| - w_i ln|Sigma_i| - w_j ln|Sigma_j|) / 2, in nats. Never
// negative; the bounds of successive merges telescope, so a sum does not depend on their order.
double merge_cost(const GaussianComponent& i, const GaussianComponent& j);

using ReductionResult = Reduction<GaussianComponent>;

// Merges the cheapest pair while the accumulated cost stays within the limit, and on until no
// more than max_components (>= 1) are left. At most 64 components;
// those that are no Gaussians (see GaussianMixture) are left out.
ReductionResult reduce_mixture(std::span<const GaussianComponent> components,
                               const MergeLimit& limit, int max_components);

}  // namespace waylight
