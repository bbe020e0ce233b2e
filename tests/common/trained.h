#pragma once
// Caches of a small scene, and how renders with them compare.

#include "common/lent_fits.h"
#include "libguide/brdf_fit.h"
#include "libguide/cache_train.h"
#include "libguide/photon_trace.h"
#include "libguide/render.h"

namespace waylight::testing {

struct Trained {
  BrdfCache brdf;
  GuideCache guide;

  RenderCaches caches() const { return {lend(brdf), GuideCacheView(guide)}; }
};

// places: the photons of media are traced again for the places that they come from.
inline Trained train(const Scene& scene, uint64_t photons, bool merge_alike = false,
                     bool places = false) {
  PhotonTraceOptions trace;
  trace.count = photons;
  CacheTrainOptions options;
  options.photons_per_cell = 1000;
  options.merge_alike = merge_alike;
  options.direct = DirectLight::drop;  // next-event estimation has it; kept, it costs 15 %
  CacheTrainer trainer(options, {scene.bounds(), photons, 0});
  trace_photons(
      scene, trace, [&](std::span<const Photon> batch) { trainer.consume(batch); }, {}, {}, {},
      [&](std::span<const MediumPhoton> batch) { trainer.consume(batch); });
  if (places)
    trace_photons(
        scene, trace, [](std::span<const Photon>) {}, {}, {}, {},
        [&](std::span<const MediumPhoton> batch) { trainer.refit(batch); });
  BrdfFitOptions fit;
  fit.elevations = 32;
  return {fit_brdfs(scene.description(), fit, {}).cache, trainer.finish(nullptr)};
}

// z of the difference of the image means of two renders.
inline double mean_z(const Image& a, const Image& b) {
  double difference = 0, variance = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c) {
        difference += a.at(x, y, c) - b.at(x, y, c);
        variance += a.at(x, y, 3 + c) + b.at(x, y, 3 + c);
      }
  // Channels of one pixel go together: three times the variance bounds their covariance.
  return difference / std::sqrt(3 * variance);
}

}  // namespace waylight::testing
