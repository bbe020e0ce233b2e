#pragma once
// The cells of a finished tree of surfaces, each fitted again to the photons of the stream that lie
// in it, at most kMostPhotons of them, drawn at random.

#include <vector>

#include "libguide/cache/photon_sample.h"
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

  static constexpr size_t kMostPhotons = 512;

 private:
  TrainingCell* cell_;
  PhotonSample<WeightedPoint> photons_{kMostPhotons};
  bool refitted_ = false;
};

// What BlockTrainer takes for a tree. That which it is made from has to stay where it is.
class RefitTree {
 public:
  RefitTree() = default;
  explicit RefitTree(TrainingTree& tree) : tree_(&tree) {
    for (size_t i = 0; i < tree.size(); ++i) cells_.emplace_back(tree[i]);
  }

  uint32_t find(const Photon& photon) const { return tree_->find(photon); }
  size_t size() const { return cells_.size(); }
  RefitCell& operator[](size_t i) { return cells_[i]; }
  void split_full_cells(const TreeOptions&, const CellTrainingOptions&, double) {}  // none is
  size_t refitted() const;
  size_t bytes() const {  // at most
    return size() * (sizeof(RefitCell) + RefitCell::kMostPhotons * sizeof(WeightedPoint));
  }

 private:
  TrainingTree* tree_ = nullptr;
  std::vector<RefitCell> cells_;
};

}  // namespace waylight
