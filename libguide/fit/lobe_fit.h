#pragma once
// The fit of one entry of a BRDF cache: points, EM, held-out error.

#include <vector>

#include "libguide/directional/expectation_maximization.h"
#include "libguide/fit/lobe_target.h"

namespace waylight {

struct LobeFitOptions {
  int components = 8, samples = 512;
  uint64_t seed = 0;
  MixturePrior prior{1.01f, 2.01f, 5e-6f};
};

// The targets of one entry: one wo, or several azimuths of an anisotropic lobe, whose mean is
// fitted.
using LobeTargets = std::vector<LobeTarget>;
LobeTargets lobe_targets(const Bsdf& bsdf, float theta, bool anisotropic);

// Directions on the disk with the weights f / p, p the density of what made them: the BSDF's own
// sampler and, so that no weight explodes where f is not small and the sampler is (f / p of a
// cosine-weighted sampler grows as 1 / cos), a share uniform over the hemisphere.
std::vector<WeightedPoint> lobe_points(const LobeTargets& targets, const LobeFitOptions& options);

// Weighted MAP EM from one start; empty where f is zero everywhere. Measured over 20 lobes: further
// starts by k-means++ gain nothing on the mean, four times the points a fifth of the error for four
// times the time, and more than 32 iterations lose by fitting the points too well.
std::vector<GaussianComponent> fit_lobe(const LobeTargets& targets, const LobeFitOptions& options);

// The integral of |f - G| over the upper hemisphere, f normalised there and G the mixture's own
// sub-density, mean over the targets: in [0, 2]. By importance sampling of f, G and the hemisphere
// together, with points independent of those of the fit.
float held_out_error(const LobeTargets& targets, const GaussianMixture& mixture, uint64_t seed);

}  // namespace waylight
