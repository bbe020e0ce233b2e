#include "libguide/cache/cell_evidence.h"

#include <algorithm>

#include "libguide/directional/em_batch.h"
#include "libguide/math/saturate.h"

namespace waylight {
namespace {

// Samples before the mean is known well enough to bound others by it.
constexpr float kOwnMeanSamples = 32;

// However little of the light one kind has found, what it found is there.
constexpr double kMinBalance = 1e-3;

double effective(double sum, double sum2) { return sum2 > 0 ? sum * sum / sum2 : 0; }

}  // namespace

CellEvidence::CellEvidence(const CacheCell& cell, const CellTraining& training) {
  sums_.light_all = training.flux;
  sums_.light_guided = std::min(training.flux, training.weight_sum);
  if (cell.effective_samples > 0)
    sums_.light_guided2 = sums_.light_guided * sums_.light_guided / cell.effective_samples;
}

// Samples are cut at kMaxTrainingWeight times the mean of those that found light, as in the
// mixture.
void CellEvidence::add(const Photon& photon, float weight, bool guided) {
  CellSources& s = sums_;
  if (photon.from == TracedFrom::lights) {
    s.light_all += weight;
    if (guided) s.light_guided += weight, s.light_guided2 += double{weight} * weight;
    return;
  }
  s.camera_looks += photon.path_depth > 0;
  double w = weight;
  if (guided && s.camera_samples >= kOwnMeanSamples)
    w = std::min(w, kMaxTrainingWeight * s.camera_guided / s.camera_samples);
  s.camera_all += w;
  if (!guided) return;
  s.camera_guided += w, s.camera_guided2 += w * w;
  s.camera_samples += 1;
}

double CellEvidence::light_samples() const {
  return effective(sums_.light_guided, sums_.light_guided2);
}
double CellEvidence::camera_samples() const {
  return effective(sums_.camera_guided, sums_.camera_guided2);
}

void CellEvidence::balance(double by_photons) {
  const double n = light_samples(), m = camera_samples();
  light_balance_ = camera_balance_ = 1;
  if (!(n > 0 && m > 0 && by_photons > 0)) return;
  const double light = by_photons * sums_.light_guided / sums_.light_all;
  const double camera = sums_.camera_guided / std::max(sums_.camera_looks, 1.0f);
  const double mean = (n * light + m * camera) / (n + m);
  light_balance_ = static_cast<float>(std::max(light / mean, kMinBalance));
  camera_balance_ = static_cast<float>(std::max(camera / mean, kMinBalance));
}

float CellEvidence::factor(TracedFrom from) const {
  const bool lights = from == TracedFrom::lights;
  const double sum = lights ? sums_.light_guided : sums_.camera_guided;
  const double sum2 = lights ? sums_.light_guided2 : sums_.camera_guided2;
  const float balance = lights ? light_balance_ : camera_balance_;
  return sum2 > 0 ? static_cast<float>(sum / sum2) * balance : 1;
}

float CellEvidence::irradiance(double by_photons, bool with_photons) const {
  if (sums_.camera_looks <= 0) return saturated(by_photons);
  const double n = with_photons ? light_samples() : 0, m = camera_samples();
  const double by_camera = sums_.camera_all / sums_.camera_looks;
  if (n + m <= 0) return saturated(with_photons ? by_photons : by_camera);
  return saturated((n * by_photons + m * by_camera) / (n + m));
}

CellEvidence CellEvidence::share(double share) const {
  CellEvidence result = *this;
  CellSources& s = result.sums_;
  for (double* sum : {&s.light_all, &s.light_guided, &s.light_guided2, &s.camera_all,
                      &s.camera_guided, &s.camera_guided2})
    *sum *= share;
  s.camera_samples *= static_cast<float>(share);
  s.camera_looks *= static_cast<float>(share);
  return result;
}

void CellEvidence::add(const CellEvidence& other) {
  const CellSources& from = other.sums_;
  sums_.light_all += from.light_all;
  sums_.light_guided += from.light_guided;
  sums_.light_guided2 += from.light_guided2;
  sums_.camera_all += from.camera_all;
  sums_.camera_guided += from.camera_guided;
  sums_.camera_guided2 += from.camera_guided2;
  sums_.camera_samples += from.camera_samples;
  sums_.camera_looks += from.camera_looks;
}

}  // namespace waylight
