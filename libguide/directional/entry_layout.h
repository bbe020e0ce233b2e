#pragma once
// From wo to the entry of a BRDF fit that stands for it, and from its frame to that of the shading.

#include "libguide/math/types.h"
#include "libguide/records/brdf_cache.h"

namespace waylight {

// The wo of entry i of n, in the frame of its plane.
Vec3 entry_wo(EntryLayout layout, int i, int n);

// The entry nearest to wo (unit, shading frame): by elevation, or by the angle between them.
int nearest_entry(EntryLayout layout, const Vec3& wo, int n);

// Rotation from the frame of entry i of n to the shading frame, as seen from wo: the mirror
// direction of the entry's wo goes to that of wo itself. A lobe of reflection then lies where it
// should, and the entries only need to follow how its shape changes; without, those of alpha = 0.01
// would have to be within about 0.1 degrees of wo. A single entry by elevation keeps its normal.
Mat3 entry_rotation(EntryLayout layout, const Vec3& wo, int i, int n);
// The same where entry_wo(layout, i, n) is at hand.
Mat3 entry_rotation(EntryLayout layout, const Vec3& wo, const Vec3& entry_wo, int n);

}  // namespace waylight
