#include "libguide/spatial/leaf_finder.h"

#include <gtest/gtest.h>

#include <random>

#include "libguide/spatial/tree_check.h"

namespace waylight {
namespace {

using Nodes = std::vector<CacheNode>;

// Splits leaves by chance, so that some branches are long and others end at once.
Nodes random_tree(int splits, std::mt19937& rng) {
  std::uniform_real_distribution<float> where(-1, 1);
  Nodes nodes = {{0, 0, kLeafAxis}};
  std::vector<uint32_t> leaves = {0};
  for (int i = 0; i < splits; ++i) {
    const size_t chosen = rng() % leaves.size();
    const uint32_t node = leaves[chosen], child = static_cast<uint32_t>(nodes.size());
    leaves[chosen] = child;
    leaves.push_back(child + 1);
    nodes[node] = {where(rng), child, static_cast<uint32_t>(rng() % 6)};
    nodes.insert(nodes.end(), 2, {0, 0, kLeafAxis});
  }
  for (uint32_t i = 0; i < leaves.size(); ++i) nodes[leaves[i]].child = i;
  return nodes;
}

// Splits x at 1, 2, 3, ...
Nodes chain(uint32_t depth) {
  Nodes nodes;
  for (uint32_t i = 0; i < depth; ++i) {
    nodes.push_back({static_cast<float>(i + 1), 2 * i + 1, 0});
    nodes.push_back({0, i, kLeafAxis});
  }
  nodes.push_back({0, depth, kLeafAxis});
  return nodes;
}

TEST(LeafFinder, FindsTheCellsThatAWalkOfTheTreeFinds) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<float> u(-1, 1);
  for (const int splits : {0, 1, 2, 3, 6, 7, 8, 50, 3000}) {
    const Nodes nodes = random_tree(splits, rng);
    ASSERT_EQ(check_tree(nodes, splits + 1u), "");
    const LeafFinder finder(nodes);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p(u(rng), u(rng), u(rng)), n(u(rng), u(rng), u(rng));
      ASSERT_EQ(finder.find(p, n), find_leaf(nodes, p, n)) << splits << " splits";
    }
  }
}

TEST(LeafFinder, FollowsATreeThatIsAsDeepAsTreesMayBe) {
  const Nodes nodes = chain(kMaxTreeDepth);
  const LeafFinder finder(nodes);
  for (uint32_t i = 0; i <= kMaxTreeDepth; ++i)
    EXPECT_EQ(finder.find(Vec3(static_cast<float>(i), 0, 0), Vec3::UnitZ()), i);
}

TEST(LeafFinder, PutsPlanesAndWhatIsNoNumberWhereAWalkDoes) {
  std::mt19937 rng(2);
  const float values[] = {0, -1, 1, kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()};
  const Nodes nodes = random_tree(200, rng);
  const LeafFinder finder(nodes);
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&] { return i % 2 ? values[rng() % 6] : nodes[rng() % nodes.size()].split; };
    const Vec3 p(any(), any(), any()), n(any(), any(), any());
    ASSERT_EQ(finder.find(p, n), find_leaf(nodes, p, n));
  }
}

TEST(LeafFinder, IsEmptyWithoutNodes) {
  EXPECT_TRUE(LeafFinder().empty());
  EXPECT_TRUE(LeafFinder(Nodes()).empty());
  EXPECT_FALSE(LeafFinder(Nodes{{0, 0, kLeafAxis}}).empty());
}

}  // namespace
}  // namespace waylight
