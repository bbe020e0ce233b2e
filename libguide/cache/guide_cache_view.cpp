#include "libguide/cache/guide_cache_view.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>

#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

bool finite_and_not_negative(std::initializer_list<float> values) {
  for (float v : values)
    if (!std::isfinite(v) || v < 0) return false;
  return true;
}

// In double: the determinant of a narrow but valid covariance can cancel to zero in float.
bool valid_density(const GaussianComponent& c) {
  const double det = double{c.cov_xx} * c.cov_yy - double{c.cov_xy} * c.cov_xy;
  return c.weight > 0 && finite_and_not_negative({c.weight, c.cov_xx, c.cov_yy}) &&
         std::isfinite(c.mean_x) && std::isfinite(c.mean_y) && std::isfinite(c.cov_xy) &&
         std::isfinite(det) && det > 0;
}

std::string check_mixture(const CacheCell& cell, std::span<const GaussianComponent> components) {
  if (cell.component_count > GaussianMixture::kMaxComponents)
    return fmt::format("{} components", cell.component_count);
  if (uint64_t{cell.first_component} + cell.component_count > components.size())
    return fmt::format("components end past the last of {}", components.size());
  double sum = cell.component_count == 0 ? 1 : 0;
  for (const GaussianComponent& c :
       components.subspan(cell.first_component, cell.component_count)) {
    if (!valid_density(c)) return "a component is not a valid Gaussian";
    sum += c.weight;
  }
  return std::abs(sum - 1) < 1e-3 ? std::string() : fmt::format("weights sum to {}", sum);
}

std::string check_cell(const CacheCell& cell, std::span<const GaussianComponent> components) {
  if (!(std::abs(cell.normal.squaredNorm() - 1) < 1e-3f)) return "the normal is not of unit length";
  if (!finite_and_not_negative(
          {cell.irradiance, cell.photon_count, cell.effective_samples, cell.guided_mass}))
    return "a statistic is negative or not finite";
  if (cell.guided_mass > 1.001f) return fmt::format("guided mass {}", cell.guided_mass);
  return check_mixture(cell, components);
}

}  // namespace

std::string check(const GuideCacheView& view) {
  if (!view.nodes.empty() && (view.scene_bounds.empty() || !view.scene_bounds.min.allFinite() ||
                              !view.scene_bounds.max.allFinite()))
    return "the scene bounds are empty or not finite";
  if (std::string fault = check_tree(view.nodes, view.cells.size()); !fault.empty()) return fault;
  for (size_t i = 0; i < view.cells.size(); ++i)
    if (const std::string fault = check_cell(view.cells[i], view.components); !fault.empty())
      return fmt::format("cell {}: {}", i, fault);
  return {};
}

}  // namespace waylight
