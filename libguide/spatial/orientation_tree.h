#pragma once
// A binary tree over position and surface orientation: six coordinates, one split each.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "libguide/math/types.h"

namespace waylight {

// Inner nodes split one of six coordinates: 0..2 position, 3..5 shading normal.
// child: index of the node for values < split; the other child is child + 1.
// axis 255 marks a leaf, whose `child` is the index of its cell.
struct CacheNode {
  float split = 0;
  uint32_t child = 0;
  uint32_t axis = 255;
};
static_assert(sizeof(CacheNode) == 12);

inline constexpr uint32_t kLeafAxis = 255;
inline constexpr uint32_t kNormalAxis = 3;  // the first of the three coordinates of the normal

// No tree is deeper, so that a lookup is bounded whatever the photons or a file say.
inline constexpr int kMaxTreeDepth = 96;

// The index of the cell that holds a point; nodes must be valid (check_tree) and not empty. A tree
// of a medium splits no normal axis: pass any normal. Coordinates that are NaN end in some cell.
inline uint32_t find_leaf(std::span<const CacheNode> nodes, const Vec3& position,
                          const Vec3& normal) {
  const std::array<float, 6> point = {position.x(), position.y(), position.z(),
                                      normal.x(),   normal.y(),   normal.z()};
  const CacheNode* node = nodes.data();
  while (node->axis != kLeafAxis)
    node = nodes.data() + node->child + (point[node->axis] < node->split ? 0 : 1);
  return node->child;
}

}  // namespace waylight
