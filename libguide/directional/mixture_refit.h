#pragma once
// A mixture that was learned online, fitted again to points that are all at hand.

#include <span>
#include <vector>

#include "libguide/directional/expectation_maximization.h"

namespace waylight {

// EM from `start`, which has `start_share` (in [0, 1)) of the say; then, as long as it pays, EM
// again with a lobe more where many more points lie close together than the mixture says. EM alone
// takes a beam that few photons carry for a part of a wide lobe, and a guided path that finds it
// weighs as much more as its density is too low. A lobe more has to raise the log-likelihood,
// against as many iterations without it, by what the Bayesian criterion asks for; where there are
// `components` (1..8) of them, two that differ least become one for it. Returns `start` where no
// point is valid.
std::vector<GaussianComponent> refit_mixture(std::span<const WeightedPoint> points,
                                             std::span<const GaussianComponent> start,
                                             int components, const MixturePrior& prior,
                                             float start_share);

}  // namespace waylight
