#include "libguide/cache/cell_merge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libguide/cache/cell_moments.h"
#include "libguide/cache/merge_rules.h"
#include "libguide/directional/gaussian_reduction.h"

namespace waylight {
namespace {

DensityEstimate irradiance_of(const TrainingCell& cell, const CellMergeOptions& o) {
  return {cell.irradiance(o.now, o.min_area, o.photons_per_particle),
          cell.exposure(o.now, o.min_area), cell.irradiance_samples()};
}

KnownLobes<GaussianComponent> lobes_of(const TrainingCell& cell) {
  return {cell.components(), cell.cell().effective_samples};
}

// Of both, where they are of one surface.
std::optional<Vec3> common_normal(const TrainingCell& a, const TrainingCell& b,
                                  const TrainingCell& merged, float spread) {
  if (merged.training().count > 0 && merged.training().normal_mean.norm() < spread)
    return std::nullopt;
  const Vec3 normal = mean_normal(merged.training(), a.cell().normal);
  for (const TrainingCell* cell : {&a, &b})
    if (!cell->components().empty() && cell->cell().normal.dot(normal) < spread)
      return std::nullopt;
  return normal;
}

// What both reach, and on either side of the split what the one there does; nothing where that
// would pass by what one of them knows, or through a gap between them.
std::optional<CellReach> common_reach(const TrainingCell& lower, const TrainingCell& upper,
                                      const CellSplit& split) {
  const CellReach low = lower.reach(), high = upper.reach();
  CellReach both{low.min.cwiseMax(high.min), low.max.cwiseMin(high.max)};
  if (!split.by_normal()) {
    if (!(low.max[split.axis] >= split.value && high.min[split.axis] <= split.value))
      return std::nullopt;
    both.min[split.axis] = low.min[split.axis];
    both.max[split.axis] = high.max[split.axis];
  }
  Bounds lit = lower.lit();
  lit.extend(upper.lit());
  const bool known = lit.min.allFinite() && lit.max.allFinite();
  return known && both.holds(lit.min) && both.holds(lit.max) ? std::optional(both) : std::nullopt;
}

}  // namespace

std::optional<TrainingCell> merge_if_alike(const TrainingCell& lower, const TrainingCell& upper,
                                           const CellSplit& split,
                                           const CellMergeOptions& options) {
  const std::optional<CellReach> reach = common_reach(lower, upper, split);
  if (!reach) return std::nullopt;
  TrainingCell merged = lower;
  merged.unite(upper, *reach, options.now, options.min_area);
  const std::optional<Vec3> normal = common_normal(lower, upper, merged, options.normal_spread);
  if (!normal) return std::nullopt;
  if (!same_density(irradiance_of(lower, options), irradiance_of(upper, options),
                    irradiance_of(merged, options).density))
    return std::nullopt;
  TrainingCell a = lower, b = upper;
  a.turn_to(*normal);
  b.turn_to(*normal);
  const double samples = double{a.cell().effective_samples} + b.cell().effective_samples;
  const std::vector<GaussianComponent> mixture =
      reduce_mixture(pool(lobes_of(a), lobes_of(b)),
                     MergeLimit::by_evidence(samples, kGaussianParameters), options.components)
          .components;
  if (!same_lobes<GaussianMixture>(lobes_of(a), lobes_of(b), std::span(mixture),
                                   kGaussianParameters))
    return std::nullopt;
  merged.turn_to(*normal);
  merged.take_mixture(mixture);
  return merged;
}

}  // namespace waylight
