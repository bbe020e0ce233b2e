#pragma once
// Evenly spread directions over the upper hemisphere, and which of them is nearest.

#include "libguide/math/types.h"

namespace waylight {

// The upper half of the spherical Fibonacci set of 2 count points [Keinert et al. 2015]:
//   z_i = 1 - (i + 1/2) / count,  azimuth_i = 2 pi frac(i (golden ratio - 1)),  i in 0 .. count
//   - 1.
// Every point stands for the same solid angle of 2 pi / count.
Vec3 hemisphere_fibonacci(int i, int count);

// Index of the point nearest to w, unit. Below the horizon too, nearest of the upper half. Constant
// time: about the direction the set is a lattice over (azimuth, z), whose best conditioned basis is
// known in closed form (ib., Eq. 2, 6 and 8); 16 of its points are looked at, where the paper's
// four miss the nearest by the pole and cannot know that the lower half is left out.
int nearest_hemisphere_fibonacci(const Vec3& w, int count);

}  // namespace waylight
