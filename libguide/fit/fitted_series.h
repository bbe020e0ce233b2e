#pragma once
// The entries of every fit of a plan.

#include <span>
#include <vector>

#include "libguide/fit/fit_plan.h"
#include "libguide/fit/fit_refinement.h"

namespace waylight {

struct SeriesLimits {
  float tolerance;
  int elevations, directions;  // most entries of an isotropic and of an anisotropic lobe
  LobeFitOptions lobe;
};

// Most entries of one series.
int most_entries(const PlannedFit& fit, const SeriesLimits& limits);

// The entries of one lobe.
struct FittedSeries {
  float width = 0;  // 0 where the width is not textured
  std::vector<EntryFit> entries;
  double seconds = 0, seconds_per_fit = 0;  // of one core; 0 where a family served
};

// By fit of the plan, ascending in width; empty for fits that an earlier one serves. Families are
// looked at first, in their order. Nothing at all where the user stopped.
std::vector<std::vector<FittedSeries>> fit_series(const SceneDescription& scene,
                                                  const FitPlan& plan,
                                                  std::span<const BrdfCache> families,
                                                  const SeriesLimits& limits,
                                                  const RunControl& control);

}  // namespace waylight
