// Time per sample and per evaluation of the main lobes, through Bsdf as the path loop calls it.

#include <benchmark/benchmark.h>

#include "libguide/base/sampler.h"
#include "libguide/bsdf/bsdf.h"

namespace waylight {
namespace {

constexpr int kCount = 4096;

struct Inputs {
  std::vector<Vec3> wo, wi;
  std::vector<float> u;
  std::vector<Vec2> u2;

  Inputs() {
    for (int i = 0; i < kCount; ++i) {
      Sampler sampler(1, 2, i);
      wo.push_back(square_to_cosine_hemisphere(sampler.next_2d()));
      wi.push_back(square_to_cosine_hemisphere(sampler.next_2d()));
      u.push_back(sampler.next());
      u2.push_back(sampler.next_2d());
    }
  }
};

const Inputs& inputs() {
  static const Inputs made;
  return made;
}

void bench_sample(benchmark::State& state, const MaterialModel& model) {
  const std::vector<Material> materials = {{"bench", model}};
  const Bsdf bsdf = resolve_mean(materials, 0);
  const Inputs& in = inputs();
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(bsdf.sample(in.wo[i], in.u[i], in.u2[i]));
    i = (i + 1) % kCount;
  }
}

void bench_evaluate(benchmark::State& state, const MaterialModel& model) {
  const std::vector<Material> materials = {{"bench", model}};
  const Bsdf bsdf = resolve_mean(materials, 0);
  const Inputs& in = inputs();
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(bsdf.evaluate(in.wo[i], in.wi[i]));
    i = (i + 1) % kCount;
  }
}

void bench_resolve(benchmark::State& state, const MaterialModel& model) {
  const std::vector<Material> materials = {{"bench", model}, {"sides", TwoSidedMaterial{0, 0}}};
  const ShadingPoint point;
  const Inputs& in = inputs();
  int i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(resolve(materials, 1, point, in.wo[i], TransportMode::radiance));
    i = (i + 1) % kCount;
  }
}

template <typename M>
M with(MicrofacetDistribution kind) {
  M material;
  material.distribution = kind;
  return material;
}

void register_material(const std::string& name, const MaterialModel& model) {
  benchmark::RegisterBenchmark(("bsdf/sample/" + name).c_str(),
                               [=](benchmark::State& state) { bench_sample(state, model); });
  benchmark::RegisterBenchmark(("bsdf/evaluate/" + name).c_str(),
                               [=](benchmark::State& state) { bench_evaluate(state, model); });
  benchmark::RegisterBenchmark(("bsdf/resolve/" + name).c_str(),
                               [=](benchmark::State& state) { bench_resolve(state, model); });
}

const bool registered = [] {
  constexpr MicrofacetDistribution ggx = MicrofacetDistribution::ggx,
                                   beckmann = MicrofacetDistribution::beckmann;
  register_material("diffuse", DiffuseMaterial{});
  register_material("roughconductor_ggx", with<RoughConductorMaterial>(ggx));
  register_material("roughconductor_beckmann", with<RoughConductorMaterial>(beckmann));
  register_material("roughdielectric_ggx", with<RoughDielectricMaterial>(ggx));
  register_material("roughplastic_ggx", with<RoughPlasticMaterial>(ggx));
  register_material("plastic", PlasticMaterial{});
  register_material("phong", PhongMaterial{});
  register_material("ward", WardMaterial{});
  return true;
}();

}  // namespace
}  // namespace waylight
