#pragma once
// Which materials of a scene get a fit, and at which widths.

#include <optional>
#include <string>
#include <vector>

#include "libguide/bsdf/bsdf.h"
#include "libguide/bsdf/lobe_traits.h"
#include "libguide/bsdf/textured_width.h"
#include "libguide/records/brdf_cache.h"
#include "libguide/scene/scene_description.h"

namespace waylight {

struct PlannedFit {
  int material = 0;
  Bsdf bsdf;  // at mean parameters
  LobeTraits traits;
  EntryLayout layout = EntryLayout::elevations;
  std::optional<WidthRange> width_range = std::nullopt;  // where the width is textured
  int same_as = -1;  // an earlier fit of the plan whose lobe has the same shape: it serves both
};

struct FitPlan {
  std::vector<PlannedFit> fits;      // by index of the material
  std::vector<std::string> skipped;  // "name (kind): why"
};

// Materials that some shape shows, by its front or from behind (material_behind). Two share a fit
// when their lobes, normalised, differ by no more than `tolerance` at any wo, as the integral of
// the absolute difference: those that differ in colour only do at any tolerance.
FitPlan plan_fits(const SceneDescription& scene, float tolerance);

}  // namespace waylight
