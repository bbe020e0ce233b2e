#pragma once
// Where the light of a mixture comes from: lobes that point to places [compare Ruppert et al.
// 2020].

#include <span>
#include <vector>

#include "libguide/directional/vmf_em.h"
#include "libguide/records/focused_lobe.h"

namespace waylight {

struct PlacedDirection {
  Vec3 position;
  Vec3 direction;  // unit, where the light comes from
  float weight;    // not negative
};

// EM of lobes that turn with the place. The focus of a lobe is found by how its directions change
// over the positions, not from distances that photons would have to carry: so that of a lamp seen
// through a lens is where its image is. A lobe without evidence for a place gets one `far` away (at
// most 1e15). start: of the same photons, without regard to their places; at most eight lobes.
// Empty where lobes with places explain the photons no better than lobes of directions: then the
// start is all that there is to know.
std::vector<FocusedLobe> fit_focused_lobes(std::span<const PlacedDirection> photons,
                                           std::span<const VmfComponent> start,
                                           const VmfPrior& prior, float far);

}  // namespace waylight
