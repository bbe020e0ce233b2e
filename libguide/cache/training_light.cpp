#include "libguide/cache/training_light.h"

#include "libguide/directional/vmf_em_step.h"

namespace waylight {
namespace {

constexpr size_t kLeastPhotons = 64;  // that foci are sought in

}  // namespace

std::vector<VmfComponent> VmfLobes::fit(std::span<const WeightedDirection> batch, int count,
                                        const VmfPrior& prior) {
  VmfEmOptions em;
  em.components = count;
  em.max_iterations = 16;
  em.prior = prior;
  return fit_vmf_mixture(batch, em).components;
}

StepwiseResult VmfLobes::update(std::span<VmfComponent> components,
                                std::span<VmfStatistics> statistics, float& step,
                                std::span<const WeightedDirection> batch, float samples,
                                const VmfPrior& prior) {
  return stepwise_vmf_update(components, statistics, step, batch, samples, prior);
}

int VmfLobes::grow(std::span<VmfComponent> components, std::span<VmfStatistics> statistics,
                   size_t count, int wanted) {
  return grow_vmf_mixture(components, statistics, static_cast<int>(count), wanted);
}

size_t TrainingLight::receive(const Vec3& direction, float weight, const LobeOptions& options) {
  training_.flux += weight;
  return wait(direction, weight) ? update(options) : 0;
}

size_t TrainingLight::update(const LobeOptions& options) {
  focused_.clear();  // of what was learned before
  Batch batch;
  const std::span<const Pending> photons = pending();
  for (size_t i = 0; i < photons.size(); ++i) batch[i] = {photons[i].direction, photons[i].weight};
  return learn(std::span(batch).first(photons.size()), options);
}

void TrainingLight::focus(const PhotonSample<PlacedDirection>& photons, const VmfPrior& prior,
                          float far) {
  if (photons.kept().size() < kLeastPhotons) return;
  focused_ = fit_focused_lobes(photons.kept(), components(), prior, far);
}

}  // namespace waylight
