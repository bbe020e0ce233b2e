#pragma once
// The normal that a material shades with: bump and normal maps applied.

#include "libguide/bsdf/bsdf.h"

namespace waylight {

// Unit, on the side of ng. `back`: the surface is seen from behind.
Vec3 shading_normal(std::span<const Material> materials, int material, const ShadingPoint& point,
                    bool back);

// The unit normal nearest to n with side * (n . wo) >= 1e-3; side is that of wo about ng.
Vec3 facing_normal(const Vec3& n, const Vec3& wo, float side);

}  // namespace waylight
