#pragma once
// An illumination cache as the renderer reads it: a memory-mapped file and a cache in memory alike.

#include <span>
#include <string>

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/records/guide_cache.h"

namespace waylight {

// Cells with fewer effective samples than this are not worth following: two per component of a
// full mixture. Their mixture would be noise that looks like a lobe.
inline constexpr float kMinEffectiveSamples = 16;

// A surface guides and is guided only by a cell whose normal is within 75 degrees of its own: the
// other side of a thin wall, or the next wall of a corner, may share the cell where it got too few
// photons for a cell of its own.
inline constexpr float kMinNormalCosine = 0.25f;

// Does not own what it views.
struct GuideCacheView {
  Quantity quantity = Quantity::radiance;
  Bounds scene_bounds;
  std::span<const CacheNode> nodes;
  std::span<const CacheCell> cells;
  std::span<const GaussianComponent> components;
  std::span<const uint32_t> escape_bins;
  std::span<const float> escape_weights;

  GuideCacheView() = default;
  GuideCacheView(const Bounds& bounds, std::span<const CacheNode> tree,
                 std::span<const CacheCell> leaves, std::span<const GaussianComponent> mixtures)
      : scene_bounds(bounds), nodes(tree), cells(leaves), components(mixtures) {}
  explicit GuideCacheView(const GuideCache& cache)
      : GuideCacheView(cache.scene_bounds, cache.nodes, cache.cells, cache.components) {
    quantity = cache.quantity;
    escape_bins = cache.escape_bins;
    escape_weights = cache.escape_weights;
  }
  explicit GuideCacheView(GuideCache&&) = delete;  // it would dangle

  // The cell that guides at a point of a surface; nullptr where the cache knows too little: sample
  // the BSDF there.
  const CacheCell* query(const Vec3& position, const Vec3& normal) const {
    if (nodes.empty()) return nullptr;
    const CacheCell& cell = cells[find_leaf(nodes, position, normal)];
    const bool known = cell.component_count > 0 && cell.effective_samples >= kMinEffectiveSamples &&
                       cell.normal.dot(normal) >= kMinNormalCosine;
    return known ? &cell : nullptr;
  }

  // Over the disk of Frame(cell.normal); proportional to Li cos.
  GaussianMixture mixture(const CacheCell& cell) const {
    return GaussianMixture(components.subspan(cell.first_component, cell.component_count));
  }
};

// What is wrong with a cache, or an empty string. A view that passes can be queried anywhere, and
// every mixture it gives is a valid density; file readers refuse those that do not.
std::string check(const GuideCacheView& view);

}  // namespace waylight
