// Cost of a guided path vertex with trained caches, and of the training by photon.

#include <benchmark/benchmark.h>

#include "common/lent_fits.h"
#include "common/small_scenes.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/brdf_fit.h"
#include "libguide/cache_reduce.h"
#include "libguide/cache_train.h"
#include "libguide/guiding/direction_sampler.h"
#include "libguide/photon_trace.h"

namespace waylight {
namespace {

// A vertex as a camera path meets it.
struct Vertex {
  SurfacePoint at;
  Vec3 wo;
  Sampler sampler;
};

struct Trained {
  Scene scene{testing::gap_box()};
  std::vector<Photon> photons;
  PhotonStreamInfo stream;
  BrdfCache brdf;
  GuideCache guide;
  GuidingCaches caches;
  std::vector<Vertex> vertices;  // where photons landed, seen from the side they came from

  Trained() {
    PhotonTraceOptions trace;
    trace.count = 200'000;
    const auto keep = [&](std::span<const Photon> batch) {
      photons.insert(photons.end(), batch.begin(), batch.end());
    };
    trace_photons(scene, trace, keep, {});
    stream = {scene.bounds(), trace.count, 0};
    guide = reduce(train(), {}, nullptr);
    brdf = reduce(fit_brdfs(scene.description(), {}, {}).cache, {}, nullptr);
    caches =
        GuidingCaches(testing::lend(brdf), GuideCacheView(guide), scene.description().materials);
    caches.load_fits();
    for (uint32_t i = 0; vertices.size() < 4096 && i < photons.size(); i += 16) add_vertex(i);
  }

  GuideCache train() const {
    CacheTrainer trainer({}, stream);
    trainer.consume(photons);
    return trainer.finish(nullptr);
  }

 private:
  void add_vertex(uint32_t i) {
    Sampler s(1, 1, i);
    const Vec3 wo = Frame(photons[i].normal).to_world(square_to_cosine_hemisphere(s.next_2d()));
    const auto at = scene.intersect({photons[i].position + 1e-2f * wo, -wo});
    if (at) vertices.push_back({*at, wo, s});
  }
};

const Trained& trained() {
  static const Trained made;
  return made;
}

// Query of cell and fit, product, one sample and its density.
void vertex_sample(benchmark::State& state, DirectionGuide guide) {
  const Trained& t = trained();
  size_t i = 0;
  for (auto _ : state) {
    const Vertex& v = t.vertices[i++ % t.vertices.size()];
    const DirectionSampler directions(t.scene, t.caches, {guide, 0.5f}, v.at, v.wo);
    Sampler sampler = v.sampler;
    benchmark::DoNotOptimize(directions.sample(sampler));
  }
}
BENCHMARK_CAPTURE(vertex_sample, bsdf, DirectionGuide::none);
BENCHMARK_CAPTURE(vertex_sample, illumination, DirectionGuide::illumination);
BENCHMARK_CAPTURE(vertex_sample, product, DirectionGuide::product);
BENCHMARK_CAPTURE(vertex_sample, ris, DirectionGuide::resampled);

// One more density at the same vertex, as next-event estimation asks for.
void vertex_density(benchmark::State& state, DirectionGuide guide) {
  const Trained& t = trained();
  const Vertex& v = t.vertices[0];
  const DirectionSampler directions(t.scene, t.caches, {guide, 0.5f}, v.at, v.wo);
  std::vector<Vec3> wi;
  for (int i = 0; i < 1024; ++i)
    wi.push_back(directions.resolved().frame.to_world(
        square_to_cosine_hemisphere(Sampler(2, 2, i).next_2d())));
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(directions.pdf(wi[i++ % wi.size()]));
}
BENCHMARK_CAPTURE(vertex_density, bsdf, DirectionGuide::none);
BENCHMARK_CAPTURE(vertex_density, product, DirectionGuide::product);

void train_photons(benchmark::State& state) {
  const Trained& t = trained();
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(t.train());
  state.SetItemsProcessed(state.iterations() * t.photons.size());
}
BENCHMARK(train_photons)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace waylight
