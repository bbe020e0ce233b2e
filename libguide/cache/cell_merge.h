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

// One cell in place of two siblings, or nothing where that would lose more than it saves.
//
// With n_i effective photons, irradiance E_i and mixture p_i of either, and E, p of the merged
// cell:
//   chi^2 / 2 of E_1 and E_2 about E      <=  ln(n_1 + n_2) / 2    [Schwarz 1978], and
//   n_1 KL(p_1 || p) + n_2 KL(p_2 || p)   <=  c parameters saved   (c in cell_merge.cpp).
// Each must pay for itself: what one mixture saves does not buy a wrong irradiance.
//
// Nor where it would reach places that the cell there before did not: its reach lies, on either
// side of the split, within that of the one there.
std::optional<TrainingCell> merge_if_alike(const TrainingCell& lower, const TrainingCell& upper,
                                           const CellSplit& split, const CellMergeOptions& options);

}  // namespace waylight
