#pragma once
// Whether two cells of surfaces know of the same light, as far as their photons can tell.

#include <optional>

#include "libguide/cache/training_cell.h"

namespace waylight {

struct CellMergeOptions {
  int components = 8;          // most of a mixture
  float normal_spread = 0.9f;  // shortest mean normal of one cell
  double now = 0;              // photons of the whole training
  double min_area = 0;         // see TrainingCell::irradiance()
  double photons_per_particle = 0;
};

// One cell in place of two siblings, or nothing where that would lose more than merge_rules.h
// allows, nor where it would reach places that the cell there before did not: its reach lies, on
// either side of the split, within that of the one there.
std::optional<TrainingCell> merge_if_alike(const TrainingCell& lower, const TrainingCell& upper,
                                           const CellSplit& split, const CellMergeOptions& options);

}  // namespace waylight
