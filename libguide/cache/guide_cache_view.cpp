#include "libguide/cache/guide_cache_view.h"

#include <fmt/format.h>

#include <cmath>

#include "libguide/directional/mixture_check.h"
#include "libguide/math/finite.h"
#include "libguide/spatial/escape_map.h"
#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

std::string check_cell(const CacheCell& cell, std::span<const GaussianComponent> components) {
  if (!(std::abs(cell.normal.squaredNorm() - 1) < 1e-3f)) return "the normal is not of unit length";
  if (!finite_and_not_negative(
          {cell.irradiance, cell.photon_count, cell.effective_samples, cell.guided_mass}))
    return "a statistic is negative or not finite";
  if (cell.guided_mass > 1.001f) return fmt::format("guided mass {}", cell.guided_mass);
  if (uint64_t{cell.first_component} + cell.component_count > components.size())
    return fmt::format("components end past the last of {}", components.size());
  return check_mixture(components.subspan(cell.first_component, cell.component_count));
}

std::string check_reaches(const GuideCacheView& view) {
  if (!view.reaches.empty() && view.reaches.size() != view.cells.size())
    return "the reaches do not belong to their cells";
  for (const CellReach& reach : view.reaches)
    if (!(reach.min.array() <= reach.max.array()).all())
      return "the reach of a cell is empty or no number";
  return {};
}

std::string check_escapes(const GuideCacheView& view) {
  if (view.escape_weights.size() != view.escape_bins.size() * EscapeMap::kCells)
    return "the escapes do not belong to their bins";
  for (size_t i = 0; i < view.escape_bins.size(); ++i)
    if (view.escape_bins[i] >= EscapeMap::kBins ||
        (i > 0 && view.escape_bins[i] <= view.escape_bins[i - 1]))
      return "the bins of the escapes are out of range or out of order";
  for (const float weight : view.escape_weights)
    if (!finite_and_not_negative({weight})) return "escapes are negative or not finite";
  return {};
}

}  // namespace

std::string check(const GuideCacheView& view) {
  const bool has_cells = !view.nodes.empty() || !view.medium.nodes.empty();
  if (has_cells && (view.scene_bounds.empty() || !view.scene_bounds.min.allFinite() ||
                    !view.scene_bounds.max.allFinite()))
    return "the scene bounds are empty or not finite";
  if (std::string fault = check_tree(view.nodes, view.cells.size()); !fault.empty()) return fault;
  for (size_t i = 0; i < view.cells.size(); ++i)
    if (const std::string fault = check_cell(view.cells[i], view.components); !fault.empty())
      return fmt::format("cell {}: {}", i, fault);
  if (const std::string fault = check(view.medium); !fault.empty()) return "media: " + fault;
  if (const std::string fault = check_reaches(view); !fault.empty()) return fault;
  return check_escapes(view);
}

}  // namespace waylight
