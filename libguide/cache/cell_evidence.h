#pragma once
// What photons and camera paths each tell of a cell, and how much either counts.

#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"

namespace waylight {

// Photons are flux, and lie where the light is; samples of camera paths are irradiance, and lie
// where the camera looks. Both estimate the irradiance by direction, E_s p_s(wi) of kind s. The
// mixture learns from their mean by evidence, n_s = (sum w)^2 / sum w^2 being the effective number
// of samples of a kind:
//   sum_s n_s E_s p_s / sum_s n_s E_s,
// for which a weight counts times E_s sum w / sum w^2. E_s matters where one kind has not found
// what the other did: such light is missing in its E_s too, and does not look like its own opinion.
class CellEvidence {
 public:
  CellEvidence() = default;
  explicit CellEvidence(const CellSources& sums) : sums_(sums) {}
  // Of a cell that has seen photons alone.
  CellEvidence(const CacheCell& cell, const CellTraining& training);

  // A photon, or what one camera path found. guided: the mixture takes it. Direct light counts with
  // the look that it belongs to.
  void add(const Photon& photon, float weight, bool guided);

  // E_s of the light that the mixture takes over the mean by evidence, from now on; by_photons: the
  // irradiance that photons say, 0 where that is not known yet: then E_s are taken for equal.
  void balance(double by_photons);

  // What a weight of one kind counts times: E_s / E sum w / sum w^2.
  float factor(TracedFrom from) const;

  // Of both kinds, W/m^2; with_photons: whether there was time for any.
  float irradiance(double by_photons, bool with_photons) const;

  // As if it had seen a share of this.
  CellEvidence share(double share) const;
  // As if it had seen what another did too.
  void add(const CellEvidence& other);

  // Effective samples of both kinds that the mixture took; 0 where photons alone were seen.
  double samples() const { return light_samples() + camera_samples(); }

  const CellSources& sums() const { return sums_; }

 private:
  double light_samples() const;
  double camera_samples() const;

  CellSources sums_;
  float light_balance_ = 1, camera_balance_ = 1;
};

}  // namespace waylight
