#include "libguide/cache/medium_cell_merge.h"

#include "libguide/cache/merge_rules.h"
#include "libguide/directional/vmf_reduction.h"

namespace waylight {
namespace {

KnownLobes<VmfComponent> lobes_of(const TrainingLight& light) {
  return {light.components(), light.record().effective_samples};
}

DensityEstimate fluence_of(const MediumTrainingCell& cell, const TrainingLight& light, double now,
                           float min_extent) {
  return {cell.fluence(light, now, min_extent), cell.exposure(now, min_extent),
          cell.fluence_samples(light)};
}

// The mixture of both, or nothing where it would lose too much of one.
std::optional<std::vector<VmfComponent>> common_lobes(const TrainingLight& a,
                                                      const TrainingLight& b, int components) {
  const KnownLobes<VmfComponent> first = lobes_of(a), second = lobes_of(b);
  if (first.components.empty() && second.components.empty()) return std::vector<VmfComponent>();
  const MergeLimit limit =
      MergeLimit::by_evidence(double{first.samples} + second.samples, kVmfParameters);
  std::vector<VmfComponent> lobes =
      reduce_vmf_mixture(pool(first, second), limit, components).components;
  if (!same_lobes<VmfMixture>(first, second, std::span<const VmfComponent>(lobes), kVmfParameters))
    return std::nullopt;
  return lobes;
}

}  // namespace

std::optional<MediumTrainingCell> merge_if_alike(const MediumTrainingCell& lower,
                                                 const MediumTrainingCell& upper,
                                                 const MediumCellOptions& options, double now) {
  const auto indirect =
      common_lobes(lower.indirect(), upper.indirect(), options.indirect.components);
  if (!indirect) return std::nullopt;
  const auto direct = common_lobes(lower.direct(), upper.direct(), options.direct.components);
  if (!direct) return std::nullopt;
  MediumTrainingCell merged = lower;
  merged.unite(upper, *indirect, *direct, now, options.min_extent);
  const auto same = [&](const TrainingLight& (MediumTrainingCell::*light)() const) {
    const auto of = [&](const MediumTrainingCell& cell) {
      return fluence_of(cell, (cell.*light)(), now, options.min_extent);
    };
    return same_density(of(lower), of(upper), of(merged).density);
  };
  if (!same(&MediumTrainingCell::indirect) || !same(&MediumTrainingCell::direct))
    return std::nullopt;
  return merged;
}

}  // namespace waylight
