// Costs of directional densities over the sphere: per vertex of a render of media, per photon of a
// training.

#include <benchmark/benchmark.h>

#include "libguide/directional/vmf_convolution.h"
#include "libguide/directional/vmf_product.h"
#include "libguide/directional/vmf_reduction.h"
#include "unit/directional/vmf_mixtures.h"

namespace {

using namespace waylight;
using test::random_lobes;

std::vector<Vec3> random_directions(int count) {
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) result.push_back(test::random_direction(7, i));
  return result;
}

void vmf_pdf(benchmark::State& state) {
  const VmfMixture mixture(random_lobes(state.range(0), 1));
  const std::vector<Vec3> directions = random_directions(1024);
  float sum = 0;
  for (auto _ : state)
    for (const Vec3& w : directions) benchmark::DoNotOptimize(sum += mixture.pdf(w));
  state.SetItemsProcessed(state.iterations() * directions.size());
}
BENCHMARK(vmf_pdf)->Arg(8);

void vmf_sample(benchmark::State& state) {
  const VmfMixture mixture(random_lobes(8, 1));
  const std::vector<Vec3> u = random_directions(1024);
  for (auto _ : state)
    for (const Vec3& v : u)
      benchmark::DoNotOptimize(mixture.sample(std::abs(v.x()), Vec2(std::abs(v.y()), 0.5f)));
  state.SetItemsProcessed(state.iterations() * u.size());
}
BENCHMARK(vmf_sample);

void vmf_construct(benchmark::State& state) {
  std::vector<std::vector<VmfComponent>> sets;
  for (int i = 0; i < 256; ++i) sets.push_back(random_lobes(state.range(0), i));
  for (auto _ : state)
    for (const auto& set : sets) {
      VmfMixture mixture(set);
      benchmark::DoNotOptimize(mixture);
    }
  state.SetItemsProcessed(state.iterations() * sets.size());
}
BENCHMARK(vmf_construct)->Arg(4)->Arg(8);

// A vertex as the renderer meets it: phase function (range 0 lobes) times light (range 1).
void vmf_product_vertex(benchmark::State& state) {
  std::vector<VmfMixture> phase, light;
  for (int i = 0; i < 16; ++i) {
    phase.emplace_back(random_lobes(state.range(0), i));
    light.emplace_back(random_lobes(state.range(1), 100 + i));
  }
  const std::vector<Vec3> u = random_directions(1024);
  for (auto _ : state)
    for (size_t i = 0; i < u.size(); ++i) {
      const VmfProduct product(phase[i % 16], light[i % 16]);
      const Vec3 w = product.sample(std::abs(u[i].x()), Vec2(std::abs(u[i].y()), 0.5f));
      benchmark::DoNotOptimize(product.pdf(w));
    }
  state.SetItemsProcessed(state.iterations() * u.size());
}
BENCHMARK(vmf_product_vertex)->Args({1, 4})->Args({2, 8})->Args({4, 8})->Args({8, 8});

void vmf_phase_about(benchmark::State& state) {
  const PhaseLobes phase = phase_lobes(0.9f);
  const std::vector<Vec3> directions = random_directions(1024);
  for (auto _ : state)
    for (const Vec3& w : directions) {
      VmfMixture mixture = phase.about(w);
      benchmark::DoNotOptimize(mixture);
    }
  state.SetItemsProcessed(state.iterations() * directions.size());
}
BENCHMARK(vmf_phase_about);

// With the convolution made for every direction (range 0 = 0), or once.
void vmf_convolution_pdf(benchmark::State& state) {
  const VmfMixture light(random_lobes(8, 1));
  const PhaseLobes phase = phase_lobes(state.range(1) * 0.1f);
  const VmfConvolution convolution(light, phase);
  const std::vector<Vec3> directions = random_directions(1024);
  for (auto _ : state)
    for (const Vec3& w : directions)
      benchmark::DoNotOptimize(state.range(0) ? convolution.pdf(w)
                                              : VmfConvolution(light, phase).pdf(w));
  state.SetItemsProcessed(state.iterations() * directions.size());
}
BENCHMARK(vmf_convolution_pdf)->Args({0, 4})->Args({0, 9})->Args({1, 4})->Args({1, 9});

void vmf_stepwise_em(benchmark::State& state) {
  const auto batch = test::draw(VmfMixture(random_lobes(8, 1)), state.range(0), 3);
  std::vector<VmfComponent> components = initial_vmf_components(batch, 8, {});
  std::vector<VmfStatistics> statistics(components.size());
  float step = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(stepwise_vmf_update(components, statistics, step, batch, 1000, {}));
  state.SetItemsProcessed(state.iterations() * batch.size());
}
BENCHMARK(vmf_stepwise_em)->Arg(64)->Arg(1024)->Arg(16384);

void vmf_phase_fit(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(phase_lobes(0.01f * state.range(0)));
}
BENCHMARK(vmf_phase_fit)->Arg(40)->Arg(90)->Unit(benchmark::kMillisecond);

void vmf_reduce(benchmark::State& state) {
  const auto lobes = random_lobes(8, 1);
  for (auto _ : state) benchmark::DoNotOptimize(reduce_vmf_mixture(lobes, 5, 8));
}
BENCHMARK(vmf_reduce)->Unit(benchmark::kMicrosecond);

}  // namespace
