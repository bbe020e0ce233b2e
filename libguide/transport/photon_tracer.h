#pragma once
// One light particle from its emission to its end.

#include <vector>

#include "libguide/base/sampler.h"
#include "libguide/records/photon.h"
#include "libguide/scene/scene.h"

namespace waylight {

class PhotonTracer {
 public:
  // power_scale: one over the number of particles of the stream.
  PhotonTracer(const Scene& scene, int max_depth, int rr_depth, float power_scale)
      : scene_(scene), max_depth_(max_depth), rr_depth_(rr_depth), power_scale_(power_scale) {}

  // Appends the photons of one particle; powers are divided by the number of particles.
  void trace(Sampler& sampler, std::vector<Photon>* photons, PhotonCounts* counts) const;

 private:
  struct Particle {
    Ray ray;
    Color power;
    uint32_t depth = 0;
  };
  std::optional<SurfacePoint> next_surface(Particle& particle, Sampler& sampler) const;
  void store(const Particle& particle, const SurfacePoint& at, std::vector<Photon>* photons,
             PhotonCounts* counts) const;
  bool scatter(Particle& particle, const SurfacePoint& at, const ResolvedBsdf& resolved,
               Sampler& sampler) const;

  const Scene& scene_;
  int max_depth_, rr_depth_;
  float power_scale_;
};

}  // namespace waylight
