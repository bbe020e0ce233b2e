// What each guided decision in media costs by volume vertex, as a multiple of the standard ones,
// and what tracing and training photons in media cost. One thread but where said.

#include <benchmark/benchmark.h>

#include "common/small_media.h"
#include "common/trained.h"
#include "libguide/base/parallel.h"
#include "libguide/base/stopwatch.h"
#include "libguide/scene/camera.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {
namespace {

constexpr int kWidth = 48, kHeight = 32;

// A lamp over a box of a medium that fills most of the picture.
SceneDescription lamp_over(const Medium& medium) {
  SceneDescription scene = testing::box_of(medium, {0, 0, 0}, {1, 1, 1}, kWidth, kHeight);
  const uint32_t lamp =
      testing::add_shape(scene, testing::rectangle({-1, 1.5f, -1}, {3, 0, 0}, {0, 0, 3}),
                         testing::add_material(scene, "black", DiffuseMaterial{Texture(0.0f)}));
  testing::make_light(scene, lamp, Color(9, 6, 5));
  testing::look_along_z(scene, {0.5f, 0.5f, -1}, kWidth, kHeight);
  return scene;
}

void on_surface(std::span<const Photon> /*photons*/) {}

// Of the nodes, cells and lobes that guiding needs.
double guide_bytes(const MediumCache& medium) {
  const auto bytes = []<typename T>(const std::vector<T>& v) { return v.size() * sizeof(T); };
  return double(bytes(medium.nodes) + bytes(medium.cells) + bytes(medium.components));
}

struct Setting {
  explicit Setting(const Medium& medium) : scene(lamp_over(medium)) {
    trace.count = 200'000;
    trace_photons(scene, trace, on_surface, {}, {}, {}, [&](std::span<const MediumPhoton> batch) {
      photons.insert(photons.end(), batch.begin(), batch.end());
    });
    guide = train();
    caches = GuidingCaches(nullptr, GuideCacheView(guide), {}, scene.description().media);
  }
  GuideCache train() const {
    PhotonStreamInfo stream{scene.bounds(), trace.count, 0};
    stream.media = true;
    CacheTrainer trainer({}, stream);
    trainer.consume(photons);
    return trainer.finish(nullptr);
  }

  Scene scene;
  PhotonTraceOptions trace;
  std::vector<MediumPhoton> photons;
  GuideCache guide;
  GuidingCaches caches;
};

const Setting& setting(const std::string& name) {
  static const Setting fog(testing::homogeneous(Color::Constant(4), Color::Constant(0.95f), 0.5f));
  static const Setting coloured(testing::homogeneous(Color(2, 4, 6), Color::Constant(0.95f), 0.5f));
  static const Setting cloud(testing::cloud(testing::lumpy_grid(1, 64), 12, 0.95f));
  return name == "fog" ? fog : name == "cloud" ? cloud : coloured;
}

struct Decision {
  std::string name;
  PathTracerOptions options;
};

std::vector<Decision> decisions() {
  std::vector<Decision> all;
  const auto add = [&](const std::string& name) -> PathTracerOptions& {
    all.push_back({name, PathTracerOptions()});
    return all.back().options;
  };
  add("standard");
  add("distance_guided").flight = FlightMethod::guided;
  add("distance_probability").flight = FlightMethod::probability;
  add("direction_mixture").phases = {PhaseGuide::mixture, 0.5f};
  add("direction_product").phases.guide = PhaseGuide::product;
  add("roulette_none").roulette = Roulette::none;
  add("roulette_guided").roulette = Roulette::guided;
  PathTracerOptions& split = add("split");
  split.roulette = Roulette::guided;
  split.max_split = 8;
  for (Decision& decision : all) decision.options.max_depth = 32;
  return all;
}

// Renders of one sample per pixel, and the processor time they took.
struct Passes {
  PathTracer tracer;
  uint64_t edges = 0;
  double seconds = 0;
  uint32_t count = 0;

  double run(const Camera& camera) {
    const Stopwatch watch;
    for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
      Sampler sampler(0, pixel, count);
      const Vec2 place = Vec2(pixel % kWidth, pixel / kWidth) + sampler.next_2d();
      edges += tracer.trace(camera.ray(place, sampler.next_2d()), sampler).edges;
    }
    ++count;
    const double taken = watch.cpu_seconds();
    seconds += taken;
    return taken;
  }
  double nanoseconds_per_vertex() const { return 1e9 * seconds / edges; }
};

// By turns with the standard decisions, so that what else the machine does weighs on both.
void media_vertex(benchmark::State& state, const std::string& name,
                  const PathTracerOptions& options, const PathTracerOptions& standard) {
  const Setting& s = setting(name);
  const Camera camera(s.scene.description().sensor);
  Passes with{{s.scene, s.caches, options}}, without{{s.scene, s.caches, standard}};
  for (auto _ : state) {
    without.run(camera);
    state.SetIterationTime(with.run(camera));
  }
  state.counters["ns_per_vertex"] = with.nanoseconds_per_vertex();
  state.counters["edges_per_path"] = double(with.edges) / (double(with.count) * kWidth * kHeight);
  state.counters["over_standard"] =
      with.nanoseconds_per_vertex() / without.nanoseconds_per_vertex();
}

// In media alone, by particles: those stored, and those that started.
void media_photons_traced(benchmark::State& state, const std::string& name) {
  const Setting& s = setting(name);
  const ThreadLimit limit(1);
  uint64_t stored = 0;
  for (auto _ : state)
    trace_photons(s.scene, s.trace, on_surface, {}, {}, {},
                  [&](std::span<const MediumPhoton> batch) { stored += batch.size(); });
  state.SetItemsProcessed(static_cast<int64_t>(stored));
  state.counters["stored_per_particle"] = double(stored) / state.iterations() / s.trace.count;
}

void media_photons_trained(benchmark::State& state, const std::string& name) {
  const Setting& s = setting(name);
  const ThreadLimit limit(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(s.train());
  const MediumCache& medium = s.guide.medium;
  state.SetItemsProcessed(state.iterations() * s.photons.size());
  state.counters["cells"] = double(medium.cells.size());
  state.counters["bytes_per_cell"] = guide_bytes(medium) / medium.cells.size();
}

const bool kRegistered = [] {
  for (const std::string name : {"fog", "coloured_fog", "cloud"}) {
    for (const Decision& d : decisions())
      benchmark::RegisterBenchmark(("media_vertex/" + name + "/" + d.name).c_str(), media_vertex,
                                   name, d.options, decisions()[0].options)
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    benchmark::RegisterBenchmark(("media_photons_traced/" + name).c_str(), media_photons_traced,
                                 name)
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("media_photons_trained/" + name).c_str(), media_photons_trained,
                                 name)
        ->Arg(1)
        ->Arg(2)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  return true;
}();

}  // namespace
}  // namespace waylight
