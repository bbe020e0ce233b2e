#pragma once
// How far two lobes are from being the same up to a factor.

#include "libguide/fit/lobe_target.h"

namespace waylight {

// The integral of |f_a - f_b| over the upper hemisphere, both normalised there: in [0, 2], and 0 up
// to rounding for lobes of one shape. By importance sampling of both and of the hemisphere.
float lobe_distance(const LobeTarget& a, const LobeTarget& b);

}  // namespace waylight
