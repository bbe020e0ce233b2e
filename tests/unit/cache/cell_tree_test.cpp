#include "libguide/cache/cell_tree.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

// A box of space that knows its middle, split at the middle of its longest side.
struct BoxCell {
  Bounds box;

  Vec3 centre() const { return 0.5f * (box.min + box.max); }
  CellSplit middle() const {
    int axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    return {static_cast<uint32_t>(axis), centre()[axis]};
  }
  BoxCell half(const CellSplit& split, bool upper) const {
    BoxCell half = *this;
    (upper ? half.box.min : half.box.max)[split.axis] = split.value;
    return half;
  }
};

// Cells that are small around `small`.
CellTree<BoxCell> tree_around(const Vec3& small) {
  CellTree<BoxCell> tree(BoxCell{{Vec3::Zero(), Vec3(1, 2, 4)}});
  for (int round = 0; round < 14; ++round)
    tree.split_cells(
        1000,
        [&](const BoxCell& cell) -> std::optional<CellSplit> {
          const float size = (cell.box.max - cell.box.min).maxCoeff();
          if ((cell.centre() - small).norm() > 2 * size) return std::nullopt;
          return cell.middle();
        },
        [](const BoxCell& cell, const CellSplit& split, bool upper) {
          return cell.half(split, upper);
        });
  return tree;
}

TEST(CellTree, FindsTheCellOfAPlaceBeforeAndAfterItIsSorted) {
  CellTree<BoxCell> tree = tree_around(Vec3(0.3f, 0.7f, 3));
  ASSERT_GT(tree.size(), 300u);
  for (int sorted = 0; sorted < 2; ++sorted) {
    for (size_t i = 0; i < tree.size(); ++i)
      ASSERT_EQ(tree.find(tree[i].centre(), Vec3::UnitZ()), i) << (sorted ? "sorted" : "as split");
    tree.sort_by_place();
  }
}

TEST(CellTree, SortedCellsFollowEachOtherInAWalkOfTheTree) {
  CellTree<BoxCell> tree = tree_around(Vec3(0.9f, 0.1f, 0.5f));
  tree.sort_by_place();
  uint32_t next = 0;
  std::vector<uint32_t> open = {0};
  while (!open.empty()) {
    const CacheNode node = tree.nodes()[open.back()];
    open.pop_back();
    if (node.axis == kLeafAxis)
      ASSERT_EQ(node.child, next++);
    else
      open.insert(open.end(), {node.child + 1, node.child});
  }
  EXPECT_EQ(next, tree.size());
}

}  // namespace
}  // namespace waylight
