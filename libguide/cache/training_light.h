#pragma once
// One kind of light in a cell of a medium while it is trained.

#include "libguide/cache/online_mixture.h"
#include "libguide/cache/photon_sample.h"
#include "libguide/directional/focused_fit.h"
#include "libguide/records/medium_cache.h"

namespace waylight {

struct LobeOptions {
  int components = 8;
  VmfPrior prior;
};

// von Mises-Fisher lobes over the sphere.
struct VmfLobes {
  using Component = VmfComponent;
  using Statistics = VmfStatistics;
  using Point = WeightedDirection;
  using Options = LobeOptions;
  using Record = MediumLight;
  using Training = MediumLightTraining;

  static std::vector<VmfComponent> fit(std::span<const WeightedDirection> batch, int count,
                                       const VmfPrior& prior);
  static StepwiseResult update(std::span<VmfComponent> components,
                               std::span<VmfStatistics> statistics, float& step,
                               std::span<const WeightedDirection> batch, float samples,
                               const VmfPrior& prior);
  static int grow(std::span<VmfComponent> components, std::span<VmfStatistics> statistics,
                  size_t count, int wanted);
};

class TrainingLight : public OnlineMixture<VmfLobes> {
 public:
  using OnlineMixture::OnlineMixture;

  // Returns how many photons of a full batch weighed too much.
  size_t receive(const Vec3& direction, float weight, const LobeOptions& options);
  // Takes in the photons that wait for their batch to fill if they are enough to learn from.
  size_t flush(const LobeOptions& options) { return enough_wait() ? update(options) : 0; }

  void begin_with_flux(double flux) { training_.flux = flux; }

  // Lobes that point to places, by photons that are all at hand: see fit_focused_lobes().
  void focus(const PhotonSample<PlacedDirection>& photons, const VmfPrior& prior, float far);
  std::span<const FocusedLobe> focused() const { return focused_; }
  void set_focused(std::span<const FocusedLobe> lobes) {
    focused_.assign(lobes.begin(), lobes.end());
  }

  // Becomes one with that of a sibling, whose evidence adds up; flux: of both.
  void unite(const TrainingLight& sibling, double flux, std::span<const VmfComponent> mixture) {
    training_.flux = flux;
    add_evidence(sibling);
    replace_mixture(mixture);
    focused_.clear();
  }

  void inherit(const TrainingLight& from, float share) {
    OnlineMixture::inherit(from, share);
    focused_ = from.focused_;
  }
  void inherit_as_child(const TrainingLight& parent, bool upper, const LobeOptions& options) {
    OnlineMixture::inherit_as_child(parent, upper, options);
    focused_ = parent.focused_;
  }

 private:
  size_t update(const LobeOptions& options);

  std::vector<FocusedLobe> focused_;  // empty where places make no difference
};

}  // namespace waylight
