#pragma once

#include <span>
#include <string>

#include "libguide/spatial/orientation_tree.h"

namespace waylight {

// What is wrong with the nodes of a tree over `cells` cells, or an empty string. After it,
// find_leaf ends within kMaxTreeDepth steps at a valid cell: children come after their parent and
// have one parent only, every cell has one leaf, splits are finite.
std::string check_tree(std::span<const CacheNode> nodes, size_t cells);

}  // namespace waylight
