#pragma once
// How far one mixture is from another.

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/directional/vmf_mixture.h"

namespace waylight {

// The Kullback-Leibler divergence KL(p || q) = E_p ln(p / q) in nats, by quadrature over 32 points
// of equal probability in each component of p: deterministic, to about a tenth of itself. Points
// outside the domain are left out. q is taken to be no less than 1e-20 of p; never negative, and 0
// where either is empty.
double divergence(const GaussianMixture& p, const GaussianMixture& q);
double divergence(const VmfMixture& p, const VmfMixture& q);

}  // namespace waylight
