#pragma once
// The cells of a finished tree of media, each asked by its photons of indirect light, at most
// kMostPhotons of them drawn at random, where that light comes from.

#include <vector>

#include "libguide/cache/medium_tree.h"
#include "libguide/cache/photon_sample.h"

namespace waylight {

// Keeps 14 KiB of photons at most.
class FocusCell {
 public:
  explicit FocusCell(MediumTrainingCell& cell) : light_(&cell.indirect()) {}

  size_t absorb(std::span<const MediumPhoton> block, std::span<const uint32_t> indices,
                float emitted, const MediumCellOptions& options);
  // Returns 0: as MediumTrainingCell has it, photons that weighed too much.
  size_t flush(const MediumCellOptions& options);

  static constexpr size_t kMostPhotons = 512;

 private:
  TrainingLight* light_;
  PhotonSample<PlacedDirection> photons_{kMostPhotons};
};

// What BlockTrainer takes for a tree. That which it is made from has to stay where it is.
class FocusTree {
 public:
  FocusTree() = default;
  explicit FocusTree(MediumTree& tree) : tree_(&tree) {
    for (size_t i = 0; i < tree.size(); ++i) cells_.emplace_back(tree[i]);
  }

  uint32_t find(const MediumPhoton& photon) const { return tree_->find(photon); }
  size_t size() const { return cells_.size(); }
  FocusCell& operator[](size_t i) { return cells_[i]; }
  void split_full_cells(const MediumTreeOptions&, const MediumCellOptions&, double) {}  // none is
  size_t bytes() const {                                                                // at most
    return size() * (sizeof(FocusCell) + FocusCell::kMostPhotons * sizeof(PlacedDirection));
  }

 private:
  MediumTree* tree_ = nullptr;
  std::vector<FocusCell> cells_;
};

}  // namespace waylight
