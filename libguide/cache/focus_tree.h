#pragma once
// The cells of a finished tree of media, each asked by its photons of indirect light, at most
// kMostPhotons of them drawn at random, where that light comes from.

#include "libguide/cache/medium_tree.h"
#include "libguide/cache/photon_sample.h"
#include "libguide/cache/second_reading.h"

namespace waylight {

// Keeps 14 KiB of photons at most.
class FocusCell {
 public:
  explicit FocusCell(MediumTrainingCell& cell) : light_(&cell.indirect()) {}

  size_t absorb(std::span<const MediumPhoton> block, std::span<const uint32_t> indices,
                float emitted, const MediumCellOptions& options);
  // Returns 0: as MediumTrainingCell has it, photons that weighed too much.
  size_t flush(const MediumCellOptions& options);

  using Kept = PlacedDirection;
  static constexpr size_t kMostPhotons = 512;

 private:
  TrainingLight* light_;
  PhotonSample<PlacedDirection> photons_{kMostPhotons};
};

using FocusTree = SecondReading<MediumTree, FocusCell>;

}  // namespace waylight
