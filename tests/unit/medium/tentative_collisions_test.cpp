// Points of a Poisson process along a ray, where floating point is short of digits.

#include "libguide/medium/tentative_collisions.h"

#include <gtest/gtest.h>

#include "common/small_media.h"

namespace waylight {
namespace {

constexpr int kEndless = 1 << 20;

// Of a process that never stops by itself.
int points(const BlockWalk& blocks, float factor, uint32_t index = 0) {
  Sampler sampler(1, 2, index);
  RandomStream random(sampler);
  int count = 0;
  tentative_collisions(blocks, factor, random.next(), random,
                       [&](float, float) { return ++count < kEndless; });
  return count;
}

float depth_of(BlockWalk blocks) {
  float depth = 0;
  for (RayBlock block; blocks.next(block);) depth += block.most * block.length();
  return depth;
}

TEST(TentativeCollisions, AreAsManyAsWantedInThinFog) {
  const BlockWalk fog({0, 1e-6f, 1e-6f}, 1);
  int count = 0;
  for (int i = 0; i < 100; ++i) count += points(fog, rate_factor(fog, 6), i);
  EXPECT_NEAR(count, 600, 100);  // four deviations
}

TEST(TentativeCollisions, EndWhereTheExtinctionIsNextToNothing) {
  for (const float extinction : {1e-30f, 1e-38f, 1e-44f}) {
    const BlockWalk fog({0, extinction, extinction}, 1);
    EXPECT_LT(points(fog, rate_factor(fog, 6)), 100) << extinction;
  }
}

// Steps of t are 1/16 there, of which each is 60 mean free paths.
TEST(TentativeCollisions, EndFarFromTheOrigin) {
  const ExtinctionBlocks blocks(*testing::lumpy_grid(), 1000);
  const BlockWalk walk(blocks, {Vec3(-1e6f, 0.5f, 0.5f), Vec3(1, 0, 0)}, kInfinity);
  const float depth = depth_of(walk);
  ASSERT_GT(depth, 100);
  EXPECT_NEAR(points(walk, 1), depth, 5 * std::sqrt(depth));
}

}  // namespace
}  // namespace waylight
