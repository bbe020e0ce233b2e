#pragma once
// What the walks over wrapped materials share.

#include <span>

#include "libguide/base/error.h"
#include "libguide/bsdf/material.h"

namespace waylight {

inline constexpr int kMaxWrapperDepth = 16;

inline const Material& wrapped_material(std::span<const Material> materials, int index, int depth) {
  const Material& material = materials[index];
  if (depth > kMaxWrapperDepth)
    fail("material \"{}\": wrappers are nested more than {} deep or in a circle; unnest them",
         material.name, kMaxWrapperDepth);
  return material;
}

// What is not a number counts as 0.
inline float clamp_unit(float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; }

// Texture values at a point, or their means where there is none.
struct Lookup {
  const Vec2* uv = nullptr;

  // Reflectances are kept in [0, 1].
  Color color(const Texture& texture) const {
    const Color c = uv ? texture.eval(*uv) : texture.mean();
    return {clamp_unit(c.x()), clamp_unit(c.y()), clamp_unit(c.z())};
  }
  float scalar(const Texture& texture) const {
    return uv ? texture.eval_scalar(*uv) : texture.mean().mean();
  }
  float share(const Texture& texture) const { return clamp_unit(scalar(texture)); }
};

}  // namespace waylight
