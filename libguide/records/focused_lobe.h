#pragma once

#include <cstdint>

#include "libguide/math/types.h"

namespace waylight {

// A lobe that points to a place. Seen from x it is a von Mises-Fisher lobe about the direction of
// the focus with the concentration |focus - x|^2 / size^2, as a fuzzy ball of that size looks.
// Light from far away has its focus far away.
struct FocusedLobe {
  float weight = 0;
  Vec3 focus = Vec3::Zero();
  float size = 1;  // positive
};
static_assert(sizeof(FocusedLobe) == 20);

// The indirect light of one cell of a medium as focused lobes.
struct FocusedCell {
  uint32_t cell = 0;
  uint32_t first_lobe = 0, lobe_count = 0;
};

}  // namespace waylight
