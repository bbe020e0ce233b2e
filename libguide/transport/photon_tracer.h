#pragma once
// One particle from its start to its end: a photon from an emitter, or an importon from the camera.

#include <optional>

#include "libguide/base/sampler.h"
#include "libguide/guiding/emission_guide.h"
#include "libguide/guiding/phase_sampler.h"
#include "libguide/records/photon.h"
#include "libguide/scene/medium_lights.h"
#include "libguide/scene/scene.h"
#include "libguide/transport/camera_start.h"
#include "libguide/transport/path_vertex.h"

namespace waylight {

struct PhotonTracerOptions {
  Quantity quantity = Quantity::radiance;
  int max_depth = 64, rr_depth = 4;
  float power_scale = 1;  // one over the number of particles of the stream
};

// Light that media emit begins with a path depth of one: next-event estimation does not find it, so
// to a cache it is indirect. With an importance cache, photons are guided by it where they leave
// emitters (EmissionGuide) and in the directions they scatter to (one-sample MIS with the BSDF),
// and roulette goes by what they are expected to bring to the image.
class PhotonTracer {
 public:
  // importance: empty, or of this scene; importons have none. It must outlive this.
  PhotonTracer(const Scene& scene, const PhotonTracerOptions& options,
               const GuideCacheView& importance = {});

  // Appends the photons of one particle; powers are divided by the number of particles.
  void trace(Sampler& sampler, PhotonRecords* records) const;

 private:
  struct Particle {
    Ray ray;
    Color power;
    uint32_t depth = 0;
    int medium = kNone;  // that `ray` is in
  };
  std::optional<Particle> start(Sampler& sampler) const;
  std::optional<Particle> leave_emitter(Sampler& sampler) const;
  std::optional<Particle> leave_medium(Sampler& sampler) const;
  void prepare_media();
  Particle leave_camera(Sampler& sampler) const;
  PathVertex next_vertex(Particle& particle, PhotonRecords* records, Sampler& sampler) const;
  std::optional<MediumPoint> fly(Particle& particle, float t_max, PhotonRecords* records,
                                 Sampler& sampler) const;
  bool visit(Particle& particle, const SurfacePoint& at, PhotonRecords* records,
             Sampler& sampler) const;
  bool visit(Particle& particle, const MediumPoint& at, PhotonRecords* records,
             Sampler& sampler) const;
  bool stores(const Particle& particle, const SurfacePoint& at, const Bsdf& bsdf) const;
  void store(const Particle& particle, const SurfacePoint& at, PhotonRecords* records) const;
  void store_in_medium(const Particle& particle, const Vec3& position, const Color& weight,
                       PhotonRecords* records) const;
  void store_escape(const Particle& particle, PhotonRecords* records) const;
  bool survives_guided(Particle& particle, float importance, Sampler& sampler) const;
  bool scatter(Particle& particle, const SurfacePoint& at, const DirectionSampler& directions,
               bool by_importance, Sampler& sampler) const;
  bool go_on(Particle& particle, const Color& power, float eta_scale, bool by_importance,
             Sampler& sampler) const;

  const Scene& scene_;
  PhotonTracerOptions options_;
  std::optional<CameraStart> camera_;  // of importons
  bool stores_escapes_ = false;
  GuidingCaches guide_;
  std::optional<EmissionGuide> emission_;
  std::optional<MediumLights> media_;  // that emit
  float media_prob_ = 0;               // of starting in them
  float expected_contribution_ = 0;    // of one photon to the mean of the image, luminance
  float plain_power_ = 0;              // luminance of a photon that is not guided
};

}  // namespace waylight
