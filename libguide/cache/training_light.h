#pragma once
// One kind of light in a cell of a medium while it is trained.

#include "libguide/cache/online_mixture.h"
#include "libguide/directional/vmf_em.h"
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

  // Becomes one with that of a sibling, whose evidence adds up; flux: of both.
  void unite(const TrainingLight& sibling, double flux, std::span<const VmfComponent> mixture) {
    training_.flux = flux;
    add_evidence(sibling);
    replace_mixture(mixture);
  }

  using OnlineMixture::inherit;
  using OnlineMixture::inherit_as_child;

 private:
  size_t update(const LobeOptions& options);
};

}  // namespace waylight
