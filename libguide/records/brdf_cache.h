#pragma once
// Fitted BSDFs: Gaussian mixtures proportional to f (without the cosine) for a series of wo.

#include <cstdint>
#include <string>
#include <vector>

#include "libguide/records/gaussian.h"

namespace waylight {

// The mixture of one wo. Its plane is the equal-area disk of the shading frame whose x axis is the
// horizontal part of wo, so wo = (sin theta, 0, cos theta).
struct BrdfCacheEntry {
  uint32_t first_component = 0;
  uint32_t component_count = 0;
  float held_out_error = 0;  // mean |f - G| over the hemisphere of the normalised densities, [0, 2]
};

// One material. Entry i of n stands for elevation theta = (i + 0.5) / n * pi/2; n = 1 for a
// material whose lobe does not depend on wo.
struct MaterialFit {
  uint32_t material = 0;  // index of the material in the scene
  std::string name;       // id of the material in the scene file
  std::string kind;       // its type, of the front where two-sided: "roughconductor"
  bool textured = false;  // fitted at mean parameters
  uint32_t first_entry = 0, entry_count = 0;
};

struct BrdfCache {
  std::vector<MaterialFit> materials;
  std::vector<BrdfCacheEntry> entries;
  std::vector<GaussianComponent> components;
};

}  // namespace waylight
