#pragma once
// A finished tree laid out for lookups by the million.

#include <vector>

#include "libguide/spatial/orientation_tree.h"

namespace waylight {

// Finds the same cells as find_leaf(), with a third of its cache misses: three levels of the tree
// share a cache line. A lookup in a tree of tens of thousands of cells waits for memory and for
// little else. Takes about as much memory as the nodes, which it does not refer to.
class LeafFinder {
 public:
  LeafFinder() = default;
  explicit LeafFinder(std::span<const CacheNode> nodes);  // valid (check_tree), or empty

  bool empty() const { return treelets_.empty(); }
  size_t bytes() const { return treelets_.size() * sizeof(Treelet); }

  // The index of the cell that holds a point, as find_leaf() has it; must not be empty.
  uint32_t find(const Vec3& position, const Vec3& normal) const {
    const std::array<float, 8> point = {
        position.x(), position.y(), position.z(), normal.x(), normal.y(), normal.z(), 0, 0};
    uint32_t next = 0;
    do {
      const Treelet& t = treelets_[next];
      const uint32_t first = t.second_side(0, point);
      const uint32_t second = 2 * first + t.second_side(1 + first, point);
      next = t.child[2 * second + t.second_side(3 + second, point)];
    } while (next < kFirstLeaf);
    return next - kFirstLeaf;
  }

 private:
  static constexpr uint32_t kFirstLeaf = 1u << 31;  // children from here on are cells
  static constexpr uint32_t kAxisBits = 3;

  // Seven inner nodes, a node's children at 2 i + 1 and 2 i + 2, and the eight ways out of them.
  // Where the tree has a leaf instead of a node, all ways below lead to it.
  struct alignas(64) Treelet {
    std::array<float, 7> split = {};
    uint32_t axes = 0;
    std::array<uint32_t, 8> child = {};

    uint32_t second_side(uint32_t i, const std::array<float, 8>& point) const {
      return point[(axes >> (kAxisBits * i)) & 7] < split[i] ? 0 : 1;
    }
  };
  static_assert(sizeof(Treelet) == 64);

  uint32_t add(std::span<const CacheNode> nodes, uint32_t root);
  void fill(std::span<const CacheNode> nodes, uint32_t treelet, uint32_t node, uint32_t place);

  std::vector<Treelet> treelets_;  // each before those below it
};

}  // namespace waylight
