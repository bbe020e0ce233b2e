#include "libguide/transport/glance.h"

namespace waylight {
namespace {

constexpr int kPathsPerPlace = 8;
constexpr uint64_t kLeastPlaces = 16, kMostPlaces = 64;

// The i-th of `count` places that are spread over the frame.
int spread(const PilotFrame& frame, uint64_t i, uint64_t count) {
  return static_cast<int>(i * uint64_t(frame.places()) / count);
}

PathRecord trace(const PathTracer& tracer, const PilotFrame& frame, int place, int sample) {
  Sampler sampler = frame.sampler(place, 0, sample);
  const Ray ray = frame.ray(place, 0, sampler);
  return tracer.trace(ray, sampler, {});
}

double noise_of_place(const PathTracer& tracer, const PilotFrame& frame, int place) {
  double sum = 0, squares = 0;
  for (int sample = 0; sample < kPathsPerPlace; ++sample) {
    const float found = luminance(trace(tracer, frame, place, sample).radiance);
    const double value = std::isfinite(found) ? found : 0;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kPathsPerPlace, scale = relative_scale(mean);
  return std::max(squares - sum * mean, 0.0) / (kPathsPerPlace - 1) * scale * scale;
}

}  // namespace

Glance glance(const PathTracer& tracer, const PilotFrame& frame, int paths) {
  Glance seen;
  for (int i = 0; i < paths; ++i) {
    const PathRecord path = trace(tracer, frame, spread(frame, i, paths), 0);
    seen.scatterings += path.scatterings;
    seen.guided += path.guided;
    seen.in_grids += path.in_grids;
  }
  return seen;
}

Noise relative_noise(const PathTracer& tracer, const PilotFrame& frame, uint64_t paths) {
  const uint64_t places = std::min(paths / kPathsPerPlace, kMostPlaces);
  if (places < kLeastPlaces) return {};
  double sum = 0, squares = 0;
  for (uint64_t i = 0; i < places; ++i) {
    const double noise = noise_of_place(tracer, frame, spread(frame, i, places));
    sum += noise;
    squares += noise * noise;
  }
  const double mean = sum / double(places);
  const double variance = std::max(squares - sum * mean, 0.0) / double(places - 1);
  return {mean, std::sqrt(variance / double(places))};
}

}  // namespace waylight
