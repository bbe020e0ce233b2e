#include "libguide/spatial/leaf_finder.h"

namespace waylight {

LeafFinder::LeafFinder(std::span<const CacheNode> nodes) {
  if (nodes.empty()) return;
  treelets_.reserve(nodes.size() / 4 + 1);
  add(nodes, 0);
  treelets_.shrink_to_fit();
}

uint32_t LeafFinder::add(std::span<const CacheNode> nodes, uint32_t root) {
  const uint32_t treelet = static_cast<uint32_t>(treelets_.size());
  treelets_.emplace_back();
  fill(nodes, treelet, root, 0);
  return treelet;
}

// place: of the node in its treelet; the ways out follow the inner nodes.
void LeafFinder::fill(std::span<const CacheNode> nodes, uint32_t treelet, uint32_t node,
                      uint32_t place) {
  constexpr uint32_t kInner = std::tuple_size_v<decltype(Treelet::split)>;
  const CacheNode& n = nodes[node];
  const bool leaf = n.axis == kLeafAxis;
  if (place >= kInner) {
    const uint32_t child = leaf ? kFirstLeaf + n.child : add(nodes, node);
    treelets_[treelet].child[place - kInner] = child;
    return;
  }
  if (!leaf) {
    treelets_[treelet].split[place] = n.split;
    treelets_[treelet].axes |= n.axis << (kAxisBits * place);
  }
  fill(nodes, treelet, leaf ? node : n.child, 2 * place + 1);
  fill(nodes, treelet, leaf ? node : n.child + 1, 2 * place + 2);
}

}  // namespace waylight
