#pragma once
// Fitted BSDFs: Gaussian mixtures proportional to f (without the cosine) for a series of wo.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "libguide/records/gaussian.h"

namespace waylight {

// Which wo the n entries of a series stand for, and the frame whose equal-area disk they lie on
// (directional/entry_layout.h).
enum class EntryLayout : uint8_t {
  // theta = (i + 0.5) / n * pi/2. The frame of the shading normal whose x axis is the horizontal
  // part of wo: wo = (sin theta, 0, cos theta). n = 1: any wo, the lobe does not depend on it.
  elevations,
  // hemisphere_fibonacci(i, n). The shading frame, x along dp/du: anisotropic lobes follow the
  // surface and not wo.
  fibonacci
};

// The mixture of one wo.
struct BrdfCacheEntry {
  uint32_t first_component = 0;
  uint32_t component_count = 0;
  float held_out_error = 0;  // mean |f - G| over the hemisphere of the normalised densities, [0, 2]
};

// The entries of one width of a lobe.
struct WidthSeries {
  float width = 0;  // alpha, positive (bsdf/textured_width.h)
  uint32_t first_entry = 0, entry_count = 0;
};

// One material.
struct MaterialFit {
  uint32_t material = 0;  // index of the material in the scene
  std::string name;       // id of the material in the scene file
  std::string kind;       // its type, of the front where two-sided: "roughconductor"
  bool textured = false;  // fitted at mean parameters, but for the width where there are `widths`
  uint32_t first_entry = 0, entry_count = 0;  // with `widths`: those of the middle one
  EntryLayout layout = EntryLayout::elevations;
  std::vector<WidthSeries> widths;  // where the width is textured, ascending; else empty
};

struct BrdfCache {
  std::vector<MaterialFit> materials;
  std::vector<BrdfCacheEntry> entries;
  std::vector<GaussianComponent> components;
};

// Gives the fits when they are first needed, which may read a file and throw; empty: there are
// none.
using BrdfSource = std::function<std::shared_ptr<const BrdfCache>()>;

}  // namespace waylight
