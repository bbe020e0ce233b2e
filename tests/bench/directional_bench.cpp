// Costs of directional densities: per vertex of a render, per photon of a training.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "common/stepwise_em.h"
#include "libguide/base/sampler.h"
#include "libguide/directional/em_step.h"
#include "libguide/directional/gaussian_product.h"

namespace {

using namespace waylight;

std::vector<GaussianComponent> random_components(int count, uint64_t seed) {
  std::vector<GaussianComponent> result;
  for (int k = 0; k < count; ++k) {
    Sampler s(seed, 0, k);
    const Vec2 mean = 0.8f * square_to_disk(s.next_2d()), width = s.next_2d();
    const float xx = 0.001f + 0.05f * width.x(), yy = 0.001f + 0.05f * width.y();
    result.push_back({0.1f + s.next(), mean.x(), mean.y(), xx, 0.3f * std::sqrt(xx * yy), yy});
  }
  return result;
}

std::vector<Vec2> random_points(int count) {
  std::vector<Vec2> result;
  for (int i = 0; i < count; ++i) result.push_back(square_to_disk(Sampler(7, 0, i).next_2d()));
  return result;
}

void mixture_pdf(benchmark::State& state) {
  const GaussianMixture mixture(random_components(state.range(0), 1));
  const std::vector<Vec2> points = random_points(1024);
  float sum = 0;
  for (auto _ : state)
    for (const Vec2& y : points) benchmark::DoNotOptimize(sum += mixture.pdf(y));
  state.SetItemsProcessed(state.iterations() * points.size());
}
BENCHMARK(mixture_pdf)->Arg(8);

// Sets of components as they lie in a file, more than fit the first-level cache of the processor.
std::vector<std::vector<GaussianComponent>> many_sets(int count) {
  std::vector<std::vector<GaussianComponent>> sets;
  for (int i = 0; i < 256; ++i) sets.push_back(random_components(count, i));
  return sets;
}

void mixture_construct(benchmark::State& state) {
  const auto sets = many_sets(state.range(0));
  for (auto _ : state)
    for (const auto& set : sets) {
      GaussianMixture mixture(set);
      benchmark::DoNotOptimize(mixture);
    }
  state.SetItemsProcessed(state.iterations() * sets.size());
}
BENCHMARK(mixture_construct)->Arg(2)->Arg(4)->Arg(8);

void mixture_carry(benchmark::State& state) {
  const GaussianMixture mixture(random_components(4, 1));
  const Mat3 rotation(Eigen::AngleAxisf(0.3f, Vec3(1, 2, 3).normalized()));
  for (auto _ : state) benchmark::DoNotOptimize(mixture.carried(rotation));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(mixture_carry);

void mixture_sample(benchmark::State& state) {
  const GaussianMixture mixture(random_components(8, 1));
  const std::vector<Vec2> u = random_points(1024);
  for (auto _ : state)
    for (const Vec2& v : u)
      benchmark::DoNotOptimize(mixture.sample(std::abs(v.x()), Vec2(std::abs(v.y()), 0.5f)));
  state.SetItemsProcessed(state.iterations() * u.size());
}
BENCHMARK(mixture_sample);

// A vertex as the renderer meets it: both mixtures are already in structure-of-arrays form.
struct ProductInput {
  std::vector<GaussianMixture> f, l;
  std::vector<Vec2> u = random_points(1024);

  explicit ProductInput(const benchmark::State& state) {
    for (int i = 0; i < 16; ++i) {
      f.emplace_back(random_components(state.range(0), i));
      l.emplace_back(random_components(state.range(1), 100 + i));
    }
  }
  GaussianProduct product(size_t i) const { return GaussianProduct(f[i % 16], l[i % 16]); }
};

void product_construct(benchmark::State& state) {
  const ProductInput input(state);
  for (auto _ : state)
    for (size_t i = 0; i < input.u.size(); ++i) benchmark::DoNotOptimize(input.product(i));
  state.SetItemsProcessed(state.iterations() * input.u.size());
}
BENCHMARK(product_construct)->Args({1, 4})->Args({2, 4})->Args({8, 8});

void product_vertex(benchmark::State& state) {
  const ProductInput input(state);
  for (auto _ : state)
    for (size_t i = 0; i < input.u.size(); ++i) {
      const Vec2 u = input.u[i].cwiseAbs();
      const GaussianProduct product = input.product(i);
      const auto y = product.sample(u.x(), Vec2(u.y(), 0.5f));
      if (y) benchmark::DoNotOptimize(product.pdf(*y));
    }
  state.SetItemsProcessed(state.iterations() * input.u.size());
}
BENCHMARK(product_vertex)->Args({1, 4})->Args({2, 4})->Args({8, 8});

void stepwise_em(benchmark::State& state) {
  const auto model = random_components(8, 1);
  const GaussianMixture mixture(model);
  std::vector<WeightedPoint> batch;
  for (int i = 0; static_cast<int>(batch.size()) < state.range(0); ++i) {
    Sampler s(3, 0, i);
    const float u = s.next();
    if (const auto y = mixture.sample(u, s.next_2d())) batch.push_back({*y, 0.5f + s.next()});
  }
  test::StepwiseEm em(initial_components(batch, 8, {}), {}, 0);
  for (auto _ : state) em.update(batch, 1000, {});
  state.SetItemsProcessed(state.iterations() * batch.size());
}
BENCHMARK(stepwise_em)->Arg(64)->Arg(1024)->Arg(16384);

}  // namespace
