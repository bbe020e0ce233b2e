#include "libguide/directional/mixture_refit.h"

#include <cmath>

#include "libguide/directional/gaussian_reduction.h"
#include "libguide/directional/missing_lobe.h"

namespace waylight {
namespace {

constexpr int kMostLobes = 6;  // that are put in

// Iterations before, when the mixture is nearly right and more of them fit the noise (in the
// interior scene 4 are 4 % better than 8), and after a lobe was put in.
constexpr int kIterations = 4, kIterationsWithLobe = 8;

// Nats that a lobe has to gain in place of another. With 3 chance clusters of photons take the
// lobes that broad light needs (trimmed relMSE 5 % higher in the interior), with 12 more beams of
// few photons are lost.
constexpr double kGainInPlace = 6;

// Half the logarithm of the samples for each parameter [Schwarz 1978].
double required_gain(double samples, bool in_place) {
  return in_place ? kGainInPlace : 3 * std::log(samples);
}

// Room for one more of at most `most`: those that differ least become one.
std::vector<GaussianComponent> with_lobe(std::vector<GaussianComponent> components,
                                         const GaussianComponent& lobe, int most) {
  components = reduce_mixture(components, MergeLimit(0), most - 1).components;
  for (GaussianComponent& c : components) c.weight *= 1 - lobe.weight;
  components.push_back(lobe);
  return components;
}

// The fit with the lobe that is missed most; empty where none is worth it.
std::optional<EmResult> with_missing_lobe(std::span<const WeightedPoint> points,
                                          const MissingLobes& missing, const EmResult& fit,
                                          const EmOptions& options) {
  const auto lobe = missing.find(fit.components, options.prior);
  if (!lobe || lobe->weight >= 1 || options.components < 2) return std::nullopt;
  const bool in_place = fit.components.size() >= static_cast<size_t>(options.components);
  const double least = required_gain(missing.samples(), in_place) / missing.samples();
  EmResult result =
      fit_mixture(points, options, with_lobe(fit.components, *lobe, options.components));
  if (!(result.log_likelihood - fit.log_likelihood > least)) return std::nullopt;
  const EmResult without = fit_mixture(points, options, fit.components);
  if (!(result.log_likelihood - without.log_likelihood > least)) return std::nullopt;
  return result;
}

}  // namespace

std::vector<GaussianComponent> refit_mixture(std::span<const WeightedPoint> points,
                                             std::span<const GaussianComponent> start,
                                             int components, const MixturePrior& prior,
                                             float start_share) {
  EmOptions options;
  options.components = components;
  options.prior = prior;
  options.start_share = start_share;
  options.max_iterations = kIterations;
  EmResult fit = fit_mixture(points, options, start);
  if (fit.components.empty()) return {start.begin(), start.end()};
  const MissingLobes missing(points);
  options.max_iterations = kIterationsWithLobe;
  for (int i = 0; i < kMostLobes; ++i) {
    std::optional<EmResult> further = with_missing_lobe(points, missing, fit, options);
    if (!further) break;
    fit = std::move(*further);
  }
  return fit.components;
}

}  // namespace waylight
