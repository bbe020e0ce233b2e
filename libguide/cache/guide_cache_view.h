#pragma once
// An illumination cache as the renderer reads it: a memory-mapped file and a cache in memory alike.

#include <span>
#include <string>

#include "libguide/cache/medium_cache_view.h"
#include "libguide/directional/gaussian_mixture.h"
#include "libguide/records/guide_cache.h"

namespace waylight {

// Cells with fewer effective samples than this are not followed: what they know is an ancestor's,
// from a place many times as large. In an interior with patches of sunlight, where a third of the
// cells have no more, following them did not lower the error of images.
inline constexpr float kMinEffectiveSamples = 16;

// Effective samples n at which a cell is followed half as often as one that is certain.
inline constexpr float kHalfTrustSamples = 4;

// The share of the guiding probability that a cell's evidence bears, n / (n + 4): 0.8 of one
// that saw 16 photons and 0.97 of one that saw 130. One-sample MIS that guides with probability g
// has at most 1 / (1 - g) times the second moment of BSDF sampling: a cell can do less harm the
// less it knows.
inline float guiding_trust(const CacheCell& cell) {
  return cell.effective_samples / (cell.effective_samples + kHalfTrustSamples);
}

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
  std::span<const CellReach> reaches;  // by cell, or empty
  std::span<const uint32_t> escape_bins;
  std::span<const float> escape_weights;
  MediumCacheView medium;

  GuideCacheView() = default;
  GuideCacheView(const Bounds& bounds, std::span<const CacheNode> tree,
                 std::span<const CacheCell> leaves, std::span<const GaussianComponent> mixtures)
      : scene_bounds(bounds), nodes(tree), cells(leaves), components(mixtures) {}
  explicit GuideCacheView(const GuideCache& cache)
      : GuideCacheView(cache.scene_bounds, cache.nodes, cache.cells, cache.components) {
    quantity = cache.quantity;
    reaches = cache.reaches;
    escape_bins = cache.escape_bins;
    escape_weights = cache.escape_weights;
    medium = MediumCacheView(cache.medium);
  }
  explicit GuideCacheView(GuideCache&&) = delete;  // it would dangle

  // The cell that guides at a point of a surface, as far as guiding_trust() goes; nullptr where the
  // cache knows too little: sample the BSDF there.
  const CacheCell* query(const Vec3& position, const Vec3& normal) const {
    return nodes.empty() ? nullptr : guide_at(find_leaf(nodes, position, normal), position, normal);
  }
  // The same where the cell that holds the point is known.
  const CacheCell* guide_at(uint32_t index, const Vec3& position, const Vec3& normal) const {
    const CacheCell& cell = cells[index];
    if (!reaches.empty() && !reaches[index].holds(position)) return nullptr;
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
