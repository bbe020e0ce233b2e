#pragma once
// What photons and camera paths each tell of a cell, and how much either counts.

#include <algorithm>
#include <cmath>

#include "libguide/directional/em_batch.h"
#include "libguide/records/guide_cache.h"
#include "libguide/records/photon.h"

namespace waylight {

// Photons are flux, and lie where the light is; samples of camera paths are irradiance, and lie
// where the camera looks. Within a cell either, weighted, describes the same distribution of
// directions, up to a factor. Weights times sum w / sum w^2 of their kind add up to its effective
// number of samples, (sum w)^2 / sum w^2: in the mixture, and in the irradiance, each kind then
// counts by its evidence.
class CellEvidence {
 public:
  CellEvidence() = default;
  explicit CellEvidence(const CellSources& sums) : sums_(sums) {}
  // Of a cell that has seen photons alone.
  CellEvidence(const CacheCell& cell, const CellTraining& training) {
    sums_.light_weight = training.flux;
    if (cell.effective_samples > 0)
      sums_.light_weight2 = training.flux * training.flux / cell.effective_samples;
  }

  // A photon, or what one camera path found; direct light counts with the look that it belongs to.
  void add(const Photon& photon, float weight) {
    if (photon.from == TracedFrom::lights) {
      sums_.light_weight += weight, sums_.light_weight2 += double{weight} * weight;
      return;
    }
    sums_.camera_looks += photon.path_depth > 0;
    if (weight > 0) add_found(weight);
  }

  // sum w / sum w^2 of what is known of one kind; 1 where that is nothing.
  float factor(TracedFrom from) const {
    const bool lights = from == TracedFrom::lights;
    const double sum2 = lights ? sums_.light_weight2 : sums_.camera_weight2;
    return sum2 > 0 ? static_cast<float>((lights ? sums_.light_weight : sums_.camera_weight) / sum2)
                    : 1;
  }

  // Of both kinds, W/m^2; by_photons: what photons say, with_photons: whether they had time to.
  float irradiance(float by_photons, bool with_photons) const {
    if (sums_.camera_looks <= 0) return by_photons;
    const double photons = with_photons ? effective(sums_.light_weight, sums_.light_weight2) : 0;
    const double samples = effective(sums_.camera_weight, sums_.camera_weight2);
    const double by_samples = sums_.camera_weight / sums_.camera_looks;
    if (photons + samples <= 0) return with_photons ? by_photons : 0;
    return static_cast<float>((photons * by_photons + samples * by_samples) / (photons + samples));
  }

  // As if it had seen a share of this.
  CellEvidence share(double share) const {
    CellEvidence result = *this;
    CellSources& s = result.sums_;
    for (double* sum : {&s.light_weight, &s.light_weight2, &s.camera_weight, &s.camera_weight2})
      *sum *= share;
    s.camera_samples *= static_cast<float>(share), s.camera_looks *= static_cast<float>(share);
    return result;
  }

  const CellSources& sums() const { return sums_; }

 private:
  // Samples before the mean is known well enough to bound others by it.
  static constexpr float kOwnMeanSamples = 32;

  static double effective(double sum, double sum2) { return sum2 > 0 ? sum * sum / sum2 : 0; }

  // Cut at kMaxTrainingWeight times the mean of those that found light, as in the mixture.
  void add_found(double weight) {
    if (sums_.camera_samples >= kOwnMeanSamples)
      weight = std::min(weight, kMaxTrainingWeight * sums_.camera_weight / sums_.camera_samples);
    sums_.camera_weight += weight, sums_.camera_weight2 += weight * weight;
    sums_.camera_samples += 1;
  }

  CellSources sums_;
};

}  // namespace waylight
