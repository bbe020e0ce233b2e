#pragma once
// The cells of surfaces in training.

#include "libguide/cache/cell_merge.h"
#include "libguide/cache/cell_tree.h"
#include "libguide/cache/training_cell.h"

namespace waylight {

// When cells are split, and how the scene's size enters.
struct TreeOptions {
  size_t photons_per_cell = 4000, max_cells = 200'000;
  float normal_spread = 0.9f;
  float min_extent = 0;  // standard deviation below which positions are one place
};

class TrainingTree : public CellTree<TrainingCell> {
 public:
  TrainingTree() = default;
  // previous: has training statistics and passed check() and check_training().
  explicit TrainingTree(const GuideCache& previous);

  uint32_t find(const Photon& photon) const {
    return CellTree::find(photon.position, photon.normal);
  }

  // Splits the cells that saw more than their photons, and balances the kinds of them. now: photons
  // of the whole training so far.
  void split_full_cells(const TreeOptions& tree, const CellTrainingOptions& options, double now);

  // Puts one cell in place of two siblings wherever they know of the same light. Returns
  // how many stored_bytes() that saves.
  size_t merge_alike(const CellMergeOptions& options);

  // Cells without a mixture inherit that of a relative nearby whose surface faces the same way.
  void lend_mixtures();

  // Of the cache without its training statistics.
  size_t stored_bytes() const;

  // photons_per_particle: of the whole training; 0 where no particles were emitted.
  void store(GuideCache& cache, const TreeOptions& tree, double photons_per_particle) const;
};

}  // namespace waylight
