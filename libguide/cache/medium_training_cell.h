#pragma once
// One cell of a medium while it is trained.

#include <optional>
#include <span>

#include "libguide/cache/cell_split.h"
#include "libguide/cache/training_light.h"
#include "libguide/records/photon.h"

namespace waylight {

struct MediumCellOptions {
  LobeOptions indirect, direct{4, {}};
  float min_extent = 0;   // standard deviation below which positions are one place
  float far = kInfinity;  // the distance beyond which light comes from one direction
};

// The mixture and statistics of one kind of light in a cell of a finished training.
struct TrainedLobes {
  std::span<const VmfComponent> components;
  std::span<const VmfStatistics> statistics;
};

// About 2.8 KiB; the memory of the training is this per cell and nothing per photon.
class MediumTrainingCell {
 public:
  explicit MediumTrainingCell(const Bounds& box = {}) : box_(box) {}
  // A cell of a finished training that goes on.
  MediumTrainingCell(const Bounds& box, const MediumCell& cell, const MediumTraining& training,
                     const TrainedLobes& indirect, const TrainedLobes& direct);

  // The photons of this cell in one block: block[indices[i]] in that order. Returns how many
  // weighed too much.
  size_t absorb(std::span<const MediumPhoton> block, std::span<const uint32_t> indices,
                float emitted, const MediumCellOptions& options);

  // Takes in the photons that wait for their batches to fill if they are enough to learn from.
  size_t flush(const MediumCellOptions& options);

  std::optional<CellSplit> choose_split(size_t photons_per_cell, float min_extent) const;

  // One of the two children of a split. Lobes, half of their evidence and the fluence are
  // inherited. now: photons of the whole training so far.
  MediumTrainingCell child(const CellSplit& split, bool upper, double now,
                           const MediumCellOptions& options) const;

  TrainingLight& indirect() { return indirect_; }
  const TrainingLight& indirect() const { return indirect_; }
  TrainingLight& direct() { return direct_; }
  const TrainingLight& direct() const { return direct_; }

  // Becomes one cell with its sibling, the upper one of the two, and takes the mixtures of both.
  void unite(const MediumTrainingCell& sibling, std::span<const VmfComponent> indirect,
             std::span<const VmfComponent> direct, double now, float min_extent);

  // Volume times photons of the training while the cell was there.
  double exposure(double now, float min_extent) const {
    return volume(min_extent) * (now - training_.born);
  }
  // Effective photons behind the fluence of one kind of light, what was inherited included.
  double fluence_samples(const TrainingLight& light) const;
  // Weight per volume and photon of the stream, with a few photons' worth of what its parent knew.
  double fluence(const TrainingLight& light, double now, float min_extent) const;

  const Vec3& centre() const { return training_.position_mean; }
  // When the cell was made, in photons of the whole training.
  double born() const { return training_.born; }
  void restate_birth(double born) { training_.born = born; }
  MediumTraining training() const;

 private:
  void add_positions(std::span<const MediumPhoton> block, std::span<const uint32_t> indices);
  double volume(float min_extent) const;
  void inherit_fluence(MediumTrainingCell& child, double now, float min_extent) const;

  Bounds box_;               // its part of the tree, within the scene
  MediumTraining training_;  // but for what the two kinds of light keep
  TrainingLight indirect_, direct_;
};

}  // namespace waylight
