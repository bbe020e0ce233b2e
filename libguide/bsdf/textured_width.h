#pragma once
// The width of a material's lobe, and how it varies over the surface.

#include <optional>
#include <span>

#include "libguide/bsdf/bsdf.h"
#include "libguide/bsdf/material.h"

namespace waylight {

// Widths are microfacet alphas; that of a Phong lobe is sqrt(2 / (exponent + 2)), with which it
// comes close to Beckmann of the same alpha. They are held between 1e-3 and 2.
struct WidthRange {
  float least, largest;
};

// The parameter that says how wide a material's lobe is, as the front shows it. It lives as long as
// the materials do.
class LobeWidth {
 public:
  LobeWidth(const Texture& texture, bool is_exponent)
      : texture_(&texture), is_exponent_(is_exponent) {}

  float at(const Vec2& uv) const { return width_of(texture_->eval_scalar(uv)); }
  float mean() const { return width_of(texture_->mean().mean()); }
  WidthRange range() const;

 private:
  float width_of(float parameter) const;

  const Texture* texture_;
  bool is_exponent_;
};

// Empty where the lobe has no width, where it is of a blend, or where each axis has its own.
std::optional<LobeWidth> lobe_width(std::span<const Material> materials, int material);

// As resolve_mean, with the width given. Only where lobe_width is not empty.
Bsdf resolve_at_width(std::span<const Material> materials, int material, float width);

}  // namespace waylight
