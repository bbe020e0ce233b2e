#include "libguide/spatial/orientation_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// x < 0: cell 0; else normal z < 0.5: cell 1; else cell 2.
std::vector<CacheNode> wall_tree() {
  return {{0, 1, 0}, {0, 0, kLeafAxis}, {0.5f, 3, 5}, {0, 1, kLeafAxis}, {0, 2, kLeafAxis}};
}

TEST(OrientationTree, FindsLeavesByPositionAndNormal) {
  const std::vector<CacheNode> nodes = wall_tree();
  EXPECT_EQ(find_leaf(nodes, Vec3(-1, 5, 5), Vec3::UnitZ()), 0u);
  EXPECT_EQ(find_leaf(nodes, Vec3(1, 5, 5), Vec3::UnitX()), 1u);
  EXPECT_EQ(find_leaf(nodes, Vec3(1, 5, 5), Vec3::UnitZ()), 2u);
}

TEST(OrientationTree, GivesTheSplitPlaneToTheUpperChild) {
  EXPECT_EQ(find_leaf(wall_tree(), Vec3::Zero(), Vec3::UnitZ()), 2u);
}

TEST(OrientationTree, EndsInSomeCellForPointsThatAreNotNumbers) {
  EXPECT_LT(find_leaf(wall_tree(), Vec3(kNan, 0, 0), Vec3(kNan, kNan, kNan)), 3u);
  EXPECT_LT(find_leaf(wall_tree(), Vec3(-kInfinity, 0, 0), Vec3::Zero()), 3u);
}

TEST(TreeCheck, AcceptsATreeAndTheEmptyTree) {
  EXPECT_EQ(check_tree(wall_tree(), 3), "");
  EXPECT_EQ(check_tree({}, 0), "");
}

TEST(TreeCheck, NamesTheNodeThatIsWrong) {
  const auto fault = [](size_t node, CacheNode value) {
    std::vector<CacheNode> nodes = wall_tree();
    nodes[node] = value;
    return check_tree(nodes, 3);
  };
  EXPECT_NE(fault(2, {0.5f, 1, 5}), "");           // an ancestor's child
  EXPECT_NE(fault(0, {0, 0, 0}), "");              // its own child: a loop
  EXPECT_NE(fault(2, {0.5f, 4, 5}), "");           // the pair ends outside
  EXPECT_NE(fault(2, {0.5f, 0xffffffff, 5}), "");  // child + 1 wraps
  EXPECT_NE(fault(0, {0, 1, 6}), "");              // no such axis
  EXPECT_NE(fault(0, {kNan, 1, 0}), "");
  EXPECT_NE(fault(3, {0, 3, kLeafAxis}), "");  // no such cell
  EXPECT_NE(fault(3, {0, 2, kLeafAxis}), "");  // a cell with two leaves
  EXPECT_NE(fault(0, {0, 0, kLeafAxis}).find("no parent"), std::string::npos);
  EXPECT_NE(check_tree(wall_tree(), 4), "");
  EXPECT_NE(check_tree({}, 1), "");
}

TEST(TreeCheck, RefusesATreeThatIsTooDeep) {
  std::vector<CacheNode> nodes{{0, 1, 0}};
  for (uint32_t depth = 1; depth <= kMaxTreeDepth + 1; ++depth) {
    nodes.push_back({0, depth - 1, kLeafAxis});
    nodes.push_back({0, static_cast<uint32_t>(nodes.size()) + 1, 0});
  }
  const size_t cells = kMaxTreeDepth + 2;
  nodes.back() = {0, kMaxTreeDepth + 1, kLeafAxis};
  EXPECT_NE(check_tree(nodes, cells).find("deeper"), std::string::npos);
}

// Whatever passes the check can be searched: this ends, and inside the cells.
TEST(TreeCheck, AdmitsOnlyTreesThatCanBeSearched) {
  std::mt19937 random(1);
  size_t admitted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<CacheNode> nodes = wall_tree();
    CacheNode& node = nodes[random() % nodes.size()];
    switch (random() % 3) {
      case 0:
        node.child = random() % 7;
        break;
      case 1:
        node.axis = random() % 8 == 0 ? kLeafAxis : random() % 8;
        break;
      default:
        node.split = static_cast<float>(random() % 5) - 2;
    }
    if (!check_tree(nodes, 3).empty()) continue;
    ++admitted;
    for (int i = 0; i < 8; ++i)
      ASSERT_LT(find_leaf(nodes, Vec3(i & 1 ? 1 : -1, 0, 0), Vec3(0, 0, i & 2 ? 1 : -1)), 3u);
  }
  EXPECT_GT(admitted, 1000u);
}

}  // namespace
}  // namespace waylight
