#pragma once
// The cells of a finished tree of surfaces, each fitted again to the photons of the stream that lie
// in it, at most kMostPhotons of them, drawn at random.

#include "libguide/cache/photon_sample.h"
#include "libguide/cache/second_reading.h"
#include "libguide/cache/training_tree.h"

namespace waylight {

// Keeps 6 KiB of photons at most.
class RefitCell {
 public:
  explicit RefitCell(TrainingCell& cell) : cell_(&cell) {}

  size_t absorb(std::span<const Photon> block, std::span<const uint32_t> indices, float emitted,
                const CellTrainingOptions& options);
  // Returns 0: as TrainingCell has it, photons that weighed too much.
  size_t flush(const CellTrainingOptions& options);
  bool refitted() const { return refitted_; }

  using Kept = WeightedPoint;
  static constexpr size_t kMostPhotons = 512;

 private:
  TrainingCell* cell_;
  PhotonSample<WeightedPoint> photons_{kMostPhotons};
  bool refitted_ = false;
};

using RefitTree = SecondReading<TrainingTree, RefitCell>;

}  // namespace waylight
