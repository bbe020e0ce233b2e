#pragma once
// How much of a cell of a medium the medium fills, told from its photons.

#include <cstdint>

#include "libguide/records/medium_cache.h"

namespace waylight {

// The bit of the part of a box, one of 4 x 4 x 4, that a position is in, or is nearest to.
uint64_t part_of_box(const Bounds& box, const Vec3& position);

// The parts of the box of both halves that lie, with their centre, in parts of theirs that saw a
// photon.
uint64_t parts_of_both(const Bounds& lower, uint64_t lower_parts, const Bounds& upper,
                       uint64_t upper_parts);

double box_volume(const Bounds& box);

// Volume of the box whose uniform density has the covariance C of the photons, sqrt(12^3 det C).
// Lit evenly, it is exact for boxes in any orientation, 11 % low for a ball, 15 % high for a box
// cut in half along a diagonal. In light that falls off exponentially from one side of a box to the
// other it is 2 % low where it falls to half, 9 % at an optical thickness of 2, 28 % at 4.
double photon_volume(const MediumTraining& cell);

// True when nearly all parts of the box saw a photon: whatever the light, the medium fills it. The
// eight parts at its corners may be missing from a ball in the box, more than four may not from
// what counts as full. It takes about 200 photons where the light is even.
bool fills_box(const MediumTraining& cell);

// The box where the medium fills it, else photon_volume() but no more than the box. No less than
// half of the box either where photons were seen all over it, as in a ball: in a cell that a beam
// crosses, most photons are on a line, and the medium is around it. What the parent knew until
// there are photons enough, and for a cell that saw none nor has a parent, the box.
double medium_volume(const MediumTraining& cell, const Bounds& box);

}  // namespace waylight
