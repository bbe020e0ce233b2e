#pragma once
// The closed set of lobes. One file each; contract in bsdf_sample.h.

#include <variant>

#include "libguide/bsdf/conductor.h"
#include "libguide/bsdf/dielectric.h"
#include "libguide/bsdf/diffuse.h"
#include "libguide/bsdf/phong.h"
#include "libguide/bsdf/plastic.h"
#include "libguide/bsdf/rough_conductor.h"
#include "libguide/bsdf/rough_dielectric.h"
#include "libguide/bsdf/rough_plastic.h"
#include "libguide/bsdf/thin_dielectric.h"
#include "libguide/bsdf/ward.h"

namespace waylight {

using Lobe = std::variant<Diffuse, Conductor, RoughConductor, Dielectric, ThinDielectric,
                          RoughDielectric, Plastic, RoughPlastic, Phong, Ward>;

}  // namespace waylight
