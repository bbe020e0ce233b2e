#pragma once
// Whether two cells of media know of the same light, as far as their photons can tell.

#include <optional>

#include "libguide/cache/medium_training_cell.h"

namespace waylight {

// One cell in place of two siblings, or nothing where that would lose more than merge_rules.h
// allows in the fluence or the lobes of either kind of light. now: photons of the whole training.
std::optional<MediumTrainingCell> merge_if_alike(const MediumTrainingCell& lower,
                                                 const MediumTrainingCell& upper,
                                                 const MediumCellOptions& options, double now);

}  // namespace waylight
