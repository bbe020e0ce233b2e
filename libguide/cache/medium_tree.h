#pragma once
// The cells of media in training.

#include "libguide/cache/cell_tree.h"
#include "libguide/cache/medium_training_cell.h"

namespace waylight {

struct MediumTreeOptions {
  size_t photons_per_cell = 2000, max_cells = 200'000;
};

class MediumTree : public CellTree<MediumTrainingCell> {
 public:
  explicit MediumTree(const Bounds& scene = {}) : CellTree(MediumTrainingCell(scene)) {}
  // previous: has cells and training statistics and passed check() and check_training().
  MediumTree(const MediumCache& previous, const Bounds& scene);

  uint32_t find(const MediumPhoton& photon) const {
    return CellTree::find(photon.position, Vec3::UnitZ());
  }

  // Splits the cells that saw more than their photons. now: photons of the whole training so far.
  void split_full_cells(const MediumTreeOptions& tree, const MediumCellOptions& options,
                        double now);

  // Puts one cell in place of two siblings wherever they know of the same light. now: photons of
  // the whole training.
  void merge_alike(const MediumCellOptions& options, double now);

  // Kinds of light without lobes inherit those of a relative nearby.
  void lend_mixtures();

  // cache: has none yet; fluence_scale: photons per emitted particle, 1/J to W of
  // MediumTrainingCell::fluence.
  void store(MediumCache& cache, const MediumCellOptions& options, double fluence_scale) const;
};

}  // namespace waylight
