#pragma once
// Fewer lobes for a von Mises-Fisher mixture, as gaussian_reduction.h [Runnalls 2007].

#include "libguide/directional/greedy_reduction.h"
#include "libguide/records/vmf.h"

namespace waylight {

// The one lobe with the weight and resultant of two: w A(kappa) mean = sum w_i A(kappa_i) mean_i.
VmfComponent merge(const VmfComponent& i, const VmfComponent& j);

// Entropy in nats, h(kappa) = kappa (1 - A(kappa)) - ln c(kappa).
double vmf_entropy(double kappa);

// An upper bound in nats of the Kullback-Leibler discrimination of a mixture from the one with the
// two merged to m. By convexity it is at most w_i KL(i || m) + w_j KL(j || m); the logarithm of m's
// density is linear in the direction, whose mean the merge keeps, so the two cross-entropies sum to
// the entropy of m, and
//   B = (w_i + w_j) h(kappa_m) - w_i h(kappa_i) - w_j h(kappa_j).
// Never negative; the bounds of successive merges telescope.
double merge_cost(const VmfComponent& i, const VmfComponent& j);

using VmfReductionResult = Reduction<VmfComponent>;

// Merges the cheapest pair while the accumulated cost stays within the limit, and on until no
// more than max_components (>= 1) are left. At most 64 lobes; those
// that are none (see VmfMixture) are left out.
VmfReductionResult reduce_vmf_mixture(std::span<const VmfComponent> components,
                                      const MergeLimit& limit, int max_components);

}  // namespace waylight
