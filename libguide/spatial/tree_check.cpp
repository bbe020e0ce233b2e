#include "libguide/spatial/tree_check.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace waylight {
namespace {

std::string check_leaf(const CacheNode& node, size_t index, std::vector<bool>& cell_taken) {
  if (node.child >= cell_taken.size())
    return fmt::format("node {}: cell {} of {}", index, node.child, cell_taken.size());
  if (cell_taken[node.child])
    return fmt::format("node {}: cell {} has two leaves", index, node.child);
  cell_taken[node.child] = true;
  return {};
}

// depth: -1 for a node that no parent has claimed yet.
std::string check_inner(const CacheNode& node, size_t index, std::vector<int>& depth) {
  if (node.axis >= 6) return fmt::format("node {}: axis {}", index, node.axis);
  if (!std::isfinite(node.split)) return fmt::format("node {}: the split is not finite", index);
  const size_t child = node.child;
  if (child <= index || child + 1 >= depth.size())
    return fmt::format("node {}: child {} is not between it and the end", index, child);
  if (depth[child] >= 0 || depth[child + 1] >= 0)
    return fmt::format("node {}: child {} has two parents", index, child);
  if (depth[index] >= kMaxTreeDepth) return fmt::format("node {}: deeper than a tree is", index);
  depth[child] = depth[child + 1] = depth[index] + 1;
  return {};
}

}  // namespace

std::string check_tree(std::span<const CacheNode> nodes, size_t cells) {
  if (nodes.size() + 1 != 2 * cells && !(nodes.empty() && cells == 0))
    return fmt::format("{} nodes do not make a tree of {} cells", nodes.size(), cells);
  std::vector<int> depth(nodes.size(), -1);
  std::vector<bool> cell_taken(cells);
  if (!depth.empty()) depth[0] = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (depth[i] < 0) return fmt::format("node {}: no parent before it", i);
    std::string fault = nodes[i].axis == kLeafAxis ? check_leaf(nodes[i], i, cell_taken)
                                                   : check_inner(nodes[i], i, depth);
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace waylight
