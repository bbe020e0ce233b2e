#pragma once
// Which materials of a scene get a fit, and how many entries each.

#include <string>
#include <vector>

#include "libguide/bsdf/bsdf.h"
#include "libguide/bsdf/lobe_traits.h"
#include "libguide/scene/scene_description.h"

namespace waylight {

struct PlannedFit {
  int material = 0;
  Bsdf bsdf;  // at mean parameters
  LobeTraits traits;
  int entries = 1;
  int same_as = -1;  // an earlier fit of the plan whose BSDF is the same: it serves both
};

struct FitPlan {
  std::vector<PlannedFit> fits;      // by index of the material
  std::vector<std::string> skipped;  // "name (kind): why"
};

// Materials that some shape shows, by its front or from behind (material_behind).
FitPlan plan_fits(const SceneDescription& scene, int elevations);

// Mid elevation of entry i of n, as records/brdf_cache.h says.
inline float entry_theta(int i, int n) { return (i + 0.5f) / n * (0.5f * kPi); }

}  // namespace waylight
