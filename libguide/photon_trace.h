#pragma once
// Stage: particles from the emitters, stored where they meet surfaces that are not purely specular.

#include <functional>
#include <span>

#include "libguide/base/run_control.h"
#include "libguide/records/photon.h"
#include "libguide/scene/scene.h"

namespace waylight {

struct PhotonTraceOptions {
  uint64_t count = 1'000'000;  // particles emitted, 1..4e9
  uint64_t seed = 0;
  uint32_t pass = 0;   // each pass has its own random numbers
  int max_depth = 64;  // scattering events per particle, 1..10000
  int rr_depth = 4;    // scattering events before Russian roulette begins

  void validate() const;
};

struct PhotonTraceSummary : PhotonCounts {
  double seconds = 0;
};

// Called in order, from one thread, with the photons of one chunk.
using PhotonSink = std::function<void(std::span<const Photon>)>;

PhotonTraceSummary trace_photons(const Scene& scene, const PhotonTraceOptions& options,
                                 const PhotonSink& sink, const RunControl& control);

}  // namespace waylight
