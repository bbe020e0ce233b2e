#include "libguide/spatial/leaf_walk.h"

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

// A random tree over the unit cube.
std::vector<CacheNode> random_tree(int splits) {
  std::vector<CacheNode> nodes = {{0, 0, kLeafAxis}};
  uint32_t cells = 1;
  for (int i = 0; i < splits; ++i) {
    Sampler sampler(1, 2, i);
    Vec3 p(sampler.next(), sampler.next(), sampler.next());
    size_t at = 0;
    while (nodes[at].axis != kLeafAxis)
      at = nodes[at].child + (p[nodes[at].axis] < nodes[at].split ? 0 : 1);
    const uint32_t axis = i % 3, cell = nodes[at].child;
    nodes[at] = {p[axis], static_cast<uint32_t>(nodes.size()), axis};
    nodes.push_back({0, cell, kLeafAxis});
    nodes.push_back({0, cells++, kLeafAxis});
  }
  return nodes;
}

TEST(LeafWalk, FindsTheCellOfEveryPointAlongEveryRay) {
  const std::vector<CacheNode> nodes = random_tree(300);
  for (int i = 0; i < 300; ++i) {
    Sampler sampler(3, 4, i);
    const Vec3 origin(2 * sampler.next() - 0.5f, sampler.next(), sampler.next());
    const Ray ray{origin, square_to_sphere(sampler.next_2d())};
    LeafWalk walk(nodes, ray, 2);
    float last = 0;
    for (LeafSpan span; walk.next(span); last = span.t1) {
      ASSERT_EQ(span.t0, last);
      ASSERT_GE(span.t1, span.t0);
      if (span.t1 - span.t0 < 1e-5f) continue;
      const Vec3 middle = ray(0.5f * (span.t0 + span.t1));
      EXPECT_EQ(span.cell, find_leaf(nodes, middle, Vec3::UnitZ()));
    }
    EXPECT_EQ(last, 2);
  }
}

TEST(LeafWalk, RaysAlongPlanesAndAxesEnd) {
  const std::vector<CacheNode> nodes = {
      {0.5f, 1, 0}, {0.5f, 3, 1}, {0, 0, kLeafAxis}, {0, 1, kLeafAxis}, {0, 2, kLeafAxis}};
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(-1, 0, 0)}) {
    LeafWalk walk(nodes, {Vec3(0.5f, 0.5f, 0.5f), direction}, kInfinity);
    int cells = 0;
    float last = 0;
    for (LeafSpan span; walk.next(span) && cells < 10; ++cells) last = span.t1;
    EXPECT_LE(cells, 3);
    EXPECT_EQ(last, kInfinity);
  }
}

}  // namespace
}  // namespace waylight
