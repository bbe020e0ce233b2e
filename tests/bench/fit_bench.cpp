// Cost of one entry of a BRDF fit and of its parts: 512 points, eight components.

#include <benchmark/benchmark.h>

#include "libguide/fit/lobe_fit.h"

namespace waylight {
namespace {

RoughConductor metal(float alpha) {
  return {Color(1.66f, 0.88f, 0.52f), Color(9.2f, 6.3f, 4.8f), Color::Ones(),
          Microfacet{alpha, alpha, MicrofacetDistribution::ggx}};
}

// Elevations change from one iteration to the next, as in a fit of a whole material.
template <typename Body>
void over_elevations(benchmark::State& state, const Body& body) {
  constexpr int kElevations = 16;
  Bsdf bsdf;
  bsdf.add(metal(1e-3f * state.range(0)), 1);
  std::vector<LobeTargets> targets;
  for (int i = 0; i < kElevations; ++i)
    targets.push_back(lobe_targets(bsdf, (i + 0.5f) / kElevations * 0.5f * kPi, false));
  int i = 0;
  for (auto _ : state) body(targets[i++ % kElevations]);
}

void fit_points(benchmark::State& state) {
  over_elevations(state,
                  [](const LobeTargets& t) { benchmark::DoNotOptimize(lobe_points(t, {})); });
}
BENCHMARK(fit_points)->Arg(150);

void fit_em(benchmark::State& state) {
  over_elevations(state, [](const LobeTargets& t) { benchmark::DoNotOptimize(fit_lobe(t, {})); });
}
BENCHMARK(fit_em)->Arg(10)->Arg(50)->Arg(150)->Arg(300);

void fit_held_out_error(benchmark::State& state) {
  over_elevations(
      state,
      [mixture = GaussianMixture(std::vector<GaussianComponent>{{1, 0, 0, 0.05f, 0, 0.05f}})](
          const LobeTargets& t) { benchmark::DoNotOptimize(held_out_error(t, mixture, 0)); });
}
BENCHMARK(fit_held_out_error)->Arg(150);

}  // namespace
}  // namespace waylight
