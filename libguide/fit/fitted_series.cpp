#include "libguide/fit/fitted_series.h"

#include <utility>

#include "libguide/fit/lobe_family.h"
#include "libguide/fit/width_plan.h"

namespace waylight {
namespace {

// Series that are fitted, and their places in the result.
struct Work {
  struct Place {
    size_t fit;  // of the plan
    float width = 0;
    double planning_seconds = 0;  // of the widths, at the first of them
  };
  std::vector<Place> places;
  std::vector<FitRefinement> refinements;

  void add(const Place& place, const PlannedFit& fit, const Bsdf& bsdf,
           const SeriesLimits& limits) {
    // So few entries that no lobe which depends on wo is served by them.
    const int first = fit.layout == EntryLayout::fibonacci ? 16 : 2;
    places.push_back(place);
    refinements.emplace_back(wo_places(std::make_shared<const Bsdf>(bsdf), fit.layout), first,
                             most_entries(fit, limits), limits.tolerance, limits.lobe);
  }
};

void add_fit(Work& work, const SceneDescription& scene, size_t index, const PlannedFit& fit,
             const SeriesLimits& limits, const RunControl& control) {
  if (!fit.width_range) return work.add({index}, fit, fit.bsdf, limits);
  WidthPlan plan = plan_widths(scene.materials, fit.material, *fit.width_range, limits.tolerance,
                               limits.lobe, control);
  for (const float width : plan.widths)
    work.add({index, width, std::exchange(plan.seconds, 0)}, fit,
             resolve_at_width(scene.materials, fit.material, width), limits);
}

std::vector<FittedSeries> from_families(const SceneDescription& scene, const PlannedFit& fit,
                                        std::span<const BrdfCache> families,
                                        const SeriesLimits& limits) {
  if (!fit.traits.depends_on_wo || fit.layout != EntryLayout::elevations) return {};
  for (const BrdfCache& family : families)
    if (std::vector<FittedSeries> series =
            family_series(family, scene.materials, fit, limits.tolerance, limits.lobe.seed);
        !series.empty())
      return series;
  return {};
}

void collect(const Work& work, std::vector<std::vector<FittedSeries>>& result) {
  for (size_t i = 0; i < work.places.size(); ++i) {
    const Work::Place& place = work.places[i];
    const FitRefinement& refinement = work.refinements[i];
    result[place.fit].push_back({place.width, refinement.entries(),
                                 place.planning_seconds + refinement.seconds(),
                                 refinement.seconds_per_fit()});
  }
}

}  // namespace

int most_entries(const PlannedFit& fit, const SeriesLimits& limits) {
  if (!fit.traits.depends_on_wo) return 1;
  return fit.layout == EntryLayout::fibonacci ? limits.directions : limits.elevations;
}

std::vector<std::vector<FittedSeries>> fit_series(const SceneDescription& scene,
                                                  const FitPlan& plan,
                                                  std::span<const BrdfCache> families,
                                                  const SeriesLimits& limits,
                                                  const RunControl& control) {
  std::vector<std::vector<FittedSeries>> result(plan.fits.size());
  Work work;
  for (size_t f = 0; f < plan.fits.size(); ++f) {
    const PlannedFit& fit = plan.fits[f];
    if (fit.same_as >= 0) continue;
    result[f] = from_families(scene, fit, families, limits);
    if (result[f].empty()) add_fit(work, scene, f, fit, limits, control);
  }
  refine_all(work.refinements, control);
  if (control.stopped()) return {};
  collect(work, result);
  return result;
}

}  // namespace waylight
