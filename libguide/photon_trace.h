#pragma once
// Stage: particles from the emitters or from the camera, stored where they meet surfaces that are
// not purely specular, and camera paths that carry radiance back to such surfaces.

#include <functional>
#include <span>

#include "libguide/base/run_control.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/records/photon.h"
#include "libguide/scene/scene.h"

namespace waylight {

struct PhotonTraceOptions {
  // radiance: photons from the emitters; importance: importons from the camera.
  Quantity quantity = Quantity::radiance;
  uint64_t count = 1'000'000;  // particles emitted, 1..4e9, or 0 beside camera paths
  uint64_t paths = 0;          // camera paths beside photons, 0..4e9
  uint64_t seed = 0;
  uint32_t pass = 0;   // each pass has its own random numbers
  int max_depth = 64;  // scattering events per particle, 1..10000
  int rr_depth = 4;    // scattering events before Russian roulette begins, 0..10000

  void validate() const;
};

struct PhotonTraceSummary : PhotonCounts {
  double seconds = 0;
};

// Called in order, from one thread, with what some particles left behind.
using PhotonSink = std::function<void(std::span<const Photon>)>;
using EscapeSink = std::function<void(std::span<const Escape>)>;
using MediumPhotonSink = std::function<void(std::span<const MediumPhoton>)>;

// Caches that guide; either may be empty.
struct TraceGuides {
  GuideCacheView importance = {};  // photons
  GuideCacheView radiance = {};    // camera paths
};

// How many photons and samples a trace with camera paths will leave, by the first few thousand of
// both; 0 without camera paths.
uint64_t expected_records(const Scene& scene, const PhotonTraceOptions& options,
                          const TraceGuides& guides = {});

// escapes: may be empty; only importons escape, and only towards distant emitters. in_media: may be
// empty; importons and camera paths leave nothing in media. Photons and the samples of camera paths
// come in turns, each in proportion to what it has left.
PhotonTraceSummary trace_photons(const Scene& scene, const PhotonTraceOptions& options,
                                 const PhotonSink& photons, const RunControl& control,
                                 const EscapeSink& escapes = {}, const TraceGuides& guides = {},
                                 const MediumPhotonSink& in_media = {});

}  // namespace waylight
