// Cost of one entry of a BRDF fit and of its parts: 512 points, eight components.

#include <benchmark/benchmark.h>

#include "libguide/fit/ceres_fit.h"
#include "libguide/fit/lobe_error.h"
#include "libguide/fit/lobe_fit.h"

namespace waylight {
namespace {

RoughConductor metal(float alpha) {
  return {Color(1.66f, 0.88f, 0.52f), Color(9.2f, 6.3f, 4.8f), Color::Ones(),
          Microfacet{alpha, alpha, MicrofacetDistribution::ggx}};
}

// Elevations change from one iteration to the next, as in a fit of a whole material.
constexpr int kElevations = 16;

struct Lobes {
  Bsdf bsdf;
  LobeFitter fitter;
  std::vector<LobeTarget> targets;
  std::vector<std::vector<LobePoint>> points;

  explicit Lobes(const benchmark::State& state) : fitter(options_of(state)) {
    bsdf.add(metal(1e-3f * state.range(0)), 1);
    for (int i = 0; i < kElevations; ++i) {
      const float theta = (i + 0.5f) / kElevations * 0.5f * kPi;
      targets.push_back(LobeTarget(bsdf, {std::sin(theta), 0, std::cos(theta)}));
      points.push_back(fitter.draw_points(targets[i]));
    }
  }
  static LobeFitOptions options_of(const benchmark::State& state) {
    LobeFitOptions options;
    options.components = static_cast<int>(state.range(1));
    return options;
  }
};

void fit_points(benchmark::State& state) {
  const Lobes lobes(state);
  int i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(lobes.fitter.draw_points(lobes.targets[i++ % kElevations]));
}
BENCHMARK(fit_points)->Args({150, 8});

void fit_em(benchmark::State& state) {
  const Lobes lobes(state);
  int i = 0;
  for (auto _ : state) {
    const int at = i++ % kElevations;
    benchmark::DoNotOptimize(lobes.fitter.fit_em(lobes.targets[at], lobes.points[at]));
  }
}
BENCHMARK(fit_em)->Args({20, 8})->Args({50, 8})->Args({150, 8})->Args({300, 8})->Args({150, 16});

void fit_ceres(benchmark::State& state) {
  const Lobes lobes(state);
  std::vector<std::vector<LobeRow>> rows;
  std::vector<std::vector<GaussianComponent>> start;
  for (int i = 0; i < kElevations; ++i) {
    rows.push_back(lobe_rows(lobes.points[i], LobeFitOptions().samples));
    start.push_back(lobes.fitter.fit_em(lobes.targets[i], lobes.points[i]));
  }
  int i = 0;
  for (auto _ : state) {
    const int at = i++ % kElevations;
    benchmark::DoNotOptimize(refine_mixture(rows[at], start[at], {}));
  }
}
BENCHMARK(fit_ceres)->Args({20, 8})->Args({50, 8})->Args({150, 8})->Args({300, 8})->Args({150, 16});

// With the choice of the method and of the number of components, and the held-out error.
void fit_entry(benchmark::State& state) {
  const Lobes lobes(state);
  int i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(lobes.fitter.fit(lobes.targets[i++ % kElevations]));
}
BENCHMARK(fit_entry)->Args({150, 8});

void fit_held_out_error(benchmark::State& state) {
  const Lobes lobes(state);
  const GaussianMixture mixture(std::vector<GaussianComponent>{{1, 0, 0, 0.05f, 0, 0.05f}});
  int i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(held_out_error(lobes.targets[i++ % kElevations], mixture, 0));
}
BENCHMARK(fit_held_out_error)->Args({150, 8});

}  // namespace
}  // namespace waylight
