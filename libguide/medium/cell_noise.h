#pragma once
// Procedural noise over space: functions of a point and a seed, the same on every machine's
// threads.

#include <cstdint>

#include "libguide/math/types.h"

namespace waylight {

// How near the nearest of the points is that are strewn one to a cell of the unit lattice
// [Worley 1996]: 1 at such a point, 0 at a distance of 1 and more. Its level sets are billows,
// spheres that meet in creases.
float cell_noise(const Vec3& p, uint64_t seed);

// The mean of cell_noise over octaves, each of twice the frequency and half the weight of the one
// before: in [0, 1].
float billow_noise(const Vec3& p, int octaves, uint64_t seed);

}  // namespace waylight
