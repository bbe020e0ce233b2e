#include "libguide/cache/medium_training_cell.h"

#include "libguide/cache/medium_volume.h"
#include "libguide/cache/position_moments.h"
#include "libguide/math/saturate.h"

namespace waylight {

MediumTrainingCell::MediumTrainingCell(const Bounds& box, const MediumCell& cell,
                                       const MediumTraining& training, const TrainedLobes& indirect,
                                       const TrainedLobes& direct)
    : box_(box),
      training_(training),
      indirect_(cell.indirect, training.indirect, indirect.components, indirect.statistics),
      direct_(cell.direct, training.direct, direct.components, direct.statistics) {}

size_t MediumTrainingCell::absorb(std::span<const MediumPhoton> block,
                                  std::span<const uint32_t> indices, float emitted,
                                  const MediumCellOptions& options) {
  add_positions(block, indices);
  size_t capped = 0;
  for (const uint32_t i : indices) {
    const MediumPhoton& photon = block[i];
    const bool direct = photon.path_depth == 0;
    capped += (direct ? direct_ : indirect_)
                  .receive(photon.direction, luminance(photon.weight) * emitted,
                           direct ? options.direct : options.indirect);
  }
  return capped;
}

void MediumTrainingCell::add_positions(std::span<const MediumPhoton> block,
                                       std::span<const uint32_t> indices) {
  PositionSums sums(training_.count > 0 ? training_.position_mean
                                        : block[indices.front()].position);
  for (const uint32_t i : indices) {
    sums.add(block[i].position);
    training_.occupied |= part_of_box(box_, block[i].position);
  }
  const float count = static_cast<float>(indices.size()), n = training_.count + count;
  sums.merge_into(training_, count, count * (training_.count / n) - count, count / n);
  training_.count = n;
  if (training_.count > kMaxMomentCount) forget_half(training_);
}

size_t MediumTrainingCell::flush(const MediumCellOptions& options) {
  indirect_.keep_components(options.indirect.components);
  direct_.keep_components(options.direct.components);
  return indirect_.flush(options.indirect) + direct_.flush(options.direct);
}

std::optional<CellSplit> MediumTrainingCell::choose_split(size_t photons_per_cell,
                                                          float min_extent) const {
  if (!(training_.count > static_cast<float>(photons_per_cell))) return std::nullopt;
  return choose_position_split(training_.position_mean, training_.position_m2 / training_.count,
                               min_extent);
}

MediumTrainingCell MediumTrainingCell::child(const CellSplit& split, bool upper, double now,
                                             const MediumCellOptions& options) const {
  MediumTrainingCell child(box_);
  (upper ? child.box_.min : child.box_.max)[split.axis] = split.value;
  child.training_.position_mean = training_.position_mean;  // until it has photons
  inherit_fluence(child, now, options.min_extent);
  child.indirect_.inherit_as_child(indirect_, upper, options.indirect);
  child.direct_.inherit_as_child(direct_, upper, options.direct);
  return child;
}

// As if the child had seen kInheritedPhotons of its half of the parent's photons: where it is dark
// and the rest of the parent is not, the time without photons soon outweighs them. Where the medium
// does not fill the parent, as much of it is taken to be in the child as there are photons.
void MediumTrainingCell::inherit_fluence(MediumTrainingCell& child, double now,
                                         float min_extent) const {
  const double volume =
      fills_box(training_) ? box_volume(child.box_) : 0.5 * medium_volume(training_, box_);
  child.training_.inherited_volume = saturated(volume);
  const double photons_of_all = (now - training_.born) / training_.count;  // per photon of the cell
  const double exposure = 2 * kInheritedPhotons * photons_of_all;
  child.training_.born = now - exposure;
  child.indirect_.begin_with_flux(fluence(indirect_, now, min_extent) * volume * exposure);
  child.direct_.begin_with_flux(fluence(direct_, now, min_extent) * volume * exposure);
}

// Fluences become those of both weighed by exposure, also where the volume of the whole is not the
// sum of the two.
void MediumTrainingCell::unite(const MediumTrainingCell& sibling,
                               std::span<const VmfComponent> indirect,
                               std::span<const VmfComponent> direct, double now, float min_extent) {
  const double exposures = exposure(now, min_extent) + sibling.exposure(now, min_extent);
  const double volumes = volume(min_extent) + sibling.volume(min_extent);
  const MediumTraining& other = sibling.training_;
  training_.occupied = parts_of_both(box_, training_.occupied, sibling.box_, other.occupied);
  if (other.count > 0) add_position_moments(training_, other);
  training_.count += other.count;
  if (training_.count > kMaxMomentCount) forget_half(training_);
  box_.extend(sibling.box_);
  training_.inherited_volume = saturated(volumes);
  training_.born = std::clamp(now - exposures / volumes, 0.0, now);
  const double scale = volume(min_extent) / volumes;
  const auto flux = [&](const TrainingLight& a, const TrainingLight& b) {
    return scale * (a.training().flux + b.training().flux);
  };
  indirect_.unite(sibling.indirect_, flux(indirect_, sibling.indirect_), indirect);
  direct_.unite(sibling.direct_, flux(direct_, sibling.direct_), direct);
}

double MediumTrainingCell::volume(float min_extent) const {
  const double least = double{min_extent} * min_extent * min_extent;
  return std::max(medium_volume(training_, box_), least);
}

double MediumTrainingCell::fluence(const TrainingLight& light, double now, float min_extent) const {
  const double spread = exposure(now, min_extent);
  return spread > 0 ? light.training().flux / spread : 0;
}

// Of the cell's own photons, shared out as those that the mixtures saw, their parent's among them.
double MediumTrainingCell::fluence_samples(const TrainingLight& light) const {
  const double both = indirect_.record().photon_count + direct_.record().photon_count;
  if (!(both > 0)) return kInheritedPhotons;
  const double effective = std::min(light.record().effective_samples / both, 1.0);
  return training_.count * effective + kInheritedPhotons;
}

MediumTraining MediumTrainingCell::training() const {
  MediumTraining result = training_;
  result.indirect = indirect_.training();
  result.direct = direct_.training();
  return result;
}

}  // namespace waylight
