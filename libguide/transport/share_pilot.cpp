#include "libguide/transport/share_pilot.h"

#include <cmath>

#include "libguide/base/parallel.h"
#include "libguide/guiding/bsdf_shares.h"
#include "libguide/scene/camera.h"

namespace waylight {
namespace {

constexpr int kPixels = 16384, kMaxSpp = 8;
constexpr uint64_t kRenderPathsPerPath = 16;
constexpr int kTile = 4;
constexpr int kTilesPerRound = 128;
constexpr uint64_t kPilotStream = 0x70696c6f74;  // apart from the numbers of the render
constexpr float kRelativeFloor = 0.01f;          // of relMSE

// The whole film with about kPixels pixels, or as it is where that is smaller.
SensorDescription pilot_sensor(SensorDescription sensor) {
  FilmDescription& film = sensor.film;
  const double scale = std::sqrt(double(kPixels) / (double(film.width) * film.height));
  if (scale >= 1) return sensor;
  film.width = std::max(1, static_cast<int>(film.width * scale));
  film.height = std::max(1, static_cast<int>(film.height * scale));
  return sensor;
}

class Pilot {
 public:
  Pilot(const PathTracer& tracer, const SensorDescription& sensor, const SharePilotOptions& options)
      : tracer_(tracer), camera_(sensor), seed_(hash_combine(options.seed, kPilotStream)) {
    const uint64_t pixels = uint64_t(camera_.width()) * camera_.height();
    if (options.render_paths > 0)
      spp_ = static_cast<int>(
          std::min<uint64_t>(kMaxSpp, options.render_paths / (kRenderPathsPerPath * pixels)));
  }

  int tiles() const { return spp_ > 0 ? tiles_x() * ((camera_.height() + kTile - 1) / kTile) : 0; }

  void trace_tile(int tile, std::vector<GuidedSample>* samples) const {
    const int x0 = tile % tiles_x() * kTile, y0 = tile / tiles_x() * kTile;
    std::vector<GuidedVertex> vertices;
    double sum = 0;
    int paths = 0;
    samples->clear();
    for (int y = y0; y < std::min(y0 + kTile, camera_.height()); ++y)
      for (int x = x0; x < std::min(x0 + kTile, camera_.width()); ++x)
        for (int s = 0; s < spp_; ++s, ++paths) sum += trace(x, y, s, vertices, samples);
    const double mean = sum / paths;
    const float scale = static_cast<float>(1 / std::sqrt(mean * mean + kRelativeFloor));
    for (GuidedSample& s : *samples) s.contribution *= scale;
  }

 private:
  int tiles_x() const { return (camera_.width() + kTile - 1) / kTile; }

  // Appends what the path's vertices tell; returns the luminance of its radiance.
  float trace(int x, int y, int sample, std::vector<GuidedVertex>& vertices,
              std::vector<GuidedSample>* samples) const {
    Sampler sampler(seed_, uint64_t(y) * camera_.width() + x, sample);
    const Vec2 pixel = Vec2(x, y) + sampler.next_2d();
    vertices.clear();
    PathContext context;
    context.guided = &vertices;
    const Ray ray = camera_.ray(pixel, sampler.next_2d());
    const PathRecord record = tracer_.trace(ray, sampler, context);
    const float radiance = luminance(record.radiance);
    if (!std::isfinite(radiance)) return 0;
    for (const GuidedVertex& v : vertices)
      samples->push_back(
          {v.cell, v.bsdf_pdf, v.guide_pdf, v.pdf, std::max(radiance - v.radiance_before, 0.0f)});
    return radiance;
  }

  const PathTracer& tracer_;
  Camera camera_;
  uint64_t seed_;
  int spp_ = kMaxSpp;
};

}  // namespace

std::vector<float> learn_shares(const PathTracer& tracer, const SensorDescription& sensor,
                                size_t cells, const SharePilotOptions& options,
                                const std::function<bool()>& stop) {
  const Pilot pilot(tracer, pilot_sensor(sensor), options);
  if (pilot.tiles() == 0) return {};
  ShareLearner learner(cells, options.default_share);
  std::vector<std::vector<GuidedSample>> round(kTilesPerRound);
  // The tiles of a round lie far apart, so that a pilot that is stopped has seen all of the film.
  const int rounds = (pilot.tiles() + kTilesPerRound - 1) / kTilesPerRound;
  for (int first = 0; first < rounds && !stop(); ++first) {
    const int count = (pilot.tiles() - first + rounds - 1) / rounds;
    parallel_for(count, [&](size_t i) { pilot.trace_tile(first + int(i) * rounds, &round[i]); });
    for (int i = 0; i < count; ++i)
      for (const GuidedSample& sample : round[i]) learner.add(sample);
  }
  return learner.shares();
}

}  // namespace waylight
