#pragma once
// Refinement of a mixture by non-linear least squares on relative errors.

#include "libguide/fit/lobe_points.h"

namespace waylight {

struct CeresOptions {
  int max_iterations = 30;
  float tolerance = 4e-6f;  // decrease of the mean cost of a point at which it stops
};

struct CeresResult {
  std::vector<GaussianComponent> components;  // the start where nothing better was found
  int iterations = 0;
};

// Minimises the mean over the points of rho(r^2) / 2 with r = (G - f) / (G + floor) and
// rho(s) = 2 c^2 (sqrt(1 + s / c^2) - 1), by Levenberg-Marquardt with analytic derivatives
// [Herholz et al. 2016, section 4, with r = (G - f) / G]. Without floor and rho, a point at which G
// is nearly zero and f is not outweighs all others. Every iterate is a valid mixture
// (lobe_parameters.h).
CeresResult refine_mixture(std::span<const LobeRow> rows, std::span<const GaussianComponent> start,
                           const CeresOptions& options);

// What refine_mixture minimises.
double relative_cost(std::span<const LobeRow> rows, std::span<const GaussianComponent> components);

}  // namespace waylight
