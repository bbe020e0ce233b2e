#pragma once
// What can be told of a material's lobes before they are evaluated.

#include <span>

#include "libguide/bsdf/material.h"

namespace waylight {

// Of the smooth part at mean parameters, seen from the front.
struct LobeTraits {
  bool smooth = false;         // there is such a part
  bool uniform = true;         // f is the same for all wi of the hemisphere
  bool depends_on_wo = false;  // the shape of f as a function of wi; a factor does not count
  bool anisotropic = false;    // it also depends on the azimuth of wo
  bool textured = false;       // some parameter varies over the surface
};

LobeTraits lobe_traits(std::span<const Material> materials, int material);

// The material whose front is what is seen from behind: the material itself where both sides are
// alike or where it is not two-sided, -1 where no single one is.
int material_behind(std::span<const Material> materials, int material);

}  // namespace waylight
