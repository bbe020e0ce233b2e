#pragma once
// The part of a cache that is of media, as the renderer reads it.

#include <span>
#include <string>

#include "libguide/records/medium_cache.h"

namespace waylight {

// Does not own what it views.
struct MediumCacheView {
  std::span<const CacheNode> nodes;
  std::span<const MediumCell> cells;
  std::span<const VmfComponent> components;
  std::span<const FocusedCell> focused_cells;
  std::span<const FocusedLobe> focused_lobes;

  MediumCacheView() = default;
  explicit MediumCacheView(const MediumCache& cache)
      : nodes(cache.nodes),
        cells(cache.cells),
        components(cache.components),
        focused_cells(cache.focused_cells),
        focused_lobes(cache.focused_lobes) {}
  explicit MediumCacheView(MediumCache&&) = delete;  // it would dangle

  // The cell at a point of a medium; nullptr where the cache holds no media. One of its kinds of
  // light may have no lobes: see effective_samples.
  const MediumCell* query(const Vec3& position) const {
    return nodes.empty() ? nullptr : &cells[find_leaf(nodes, position, Vec3::UnitZ())];
  }

  // The lobes of a cell's indirect light that point to places; empty where it has none.
  std::span<const FocusedLobe> focused(uint32_t cell) const;

  // Over the sphere, proportional to the radiance that comes from a direction.
  std::span<const VmfComponent> lobes(const MediumLight& light) const {
    return components.subspan(light.first_component, light.component_count);
  }
};

// What is wrong, or an empty string. A view that passes can be queried anywhere, and every mixture
// it gives is a valid density.
std::string check(const MediumCacheView& view);

}  // namespace waylight
