#include "libguide/medium/cloud.h"

#include <gtest/gtest.h>

#include <numeric>

#include "common/small_media.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/medium/cell_noise.h"

namespace waylight {
namespace {

float uniform(uint64_t i, uint64_t dimension) {
  return static_cast<float>(hash_combine(i, dimension) >> 40) * 0x1p-24f;
}

Vec3 some_point(uint64_t i) {
  return 40 * Vec3(uniform(i, 0) - 0.5f, uniform(i, 1) - 0.5f, uniform(i, 2) - 0.5f);
}

TEST(CellNoise, IsWithinZeroAndOneAndUsesTheRange) {
  float least = 1, most = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    const float value = cell_noise(some_point(i), 3);
    ASSERT_GE(value, 0) << i;
    ASSERT_LE(value, 1) << i;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  EXPECT_LT(least, 0.15f);
  EXPECT_GT(most, 0.9f);
}

// A distance: it cannot change faster than the point moves, across the borders of cells too.
TEST(CellNoise, ChangesNoFasterThanThePointMoves) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const Vec3 p = some_point(i), step = 1e-3f * Vec3(uniform(i, 3), -uniform(i, 4), uniform(i, 5));
    const float change = std::abs(cell_noise(p + step, 3) - cell_noise(p, 3));
    ASSERT_LE(change, step.norm() + 1e-5f) << i;
  }
}

TEST(CellNoise, DependsOnTheSeed) {
  int same = 0;
  for (uint64_t i = 0; i < 1000; ++i)
    same += cell_noise(some_point(i), 1) == cell_noise(some_point(i), 2);
  EXPECT_LT(same, 10);
}

TEST(BillowNoise, IsAMeanOfOctaves) {
  const Vec3 p(0.3f, -1.7f, 2.2f);
  EXPECT_EQ(billow_noise(p, 0, 5), 0);
  EXPECT_EQ(billow_noise(p, 1, 5), cell_noise(p, hash_combine(5, 0)));
  EXPECT_FLOAT_EQ(
      billow_noise(p, 2, 5),
      (2 * cell_noise(p, hash_combine(5, 0)) + cell_noise(2 * p, hash_combine(5, 1))) / 3);
}

CloudOptions small_cloud() {
  CloudOptions options;
  options.resolution = 40;
  return options;
}

TEST(Cloud, IsWithinZeroAndOneAndPartlyEmpty) {
  const VolumeGrid grid = make_cloud(small_cloud());
  EXPECT_EQ(grid.size(), Eigen::Vector3i(40, 24, 30));
  const std::vector<float> values = testing::dense_values(grid.voxels);
  int filled = 0;
  for (const float value : values) {
    ASSERT_GE(value, 0);
    ASSERT_LE(value, 1);
    filled += value > 0;
  }
  EXPECT_GT(filled, 0.1 * double(values.size()));
  EXPECT_LT(filled, 0.7 * double(values.size()));
}

bool on_border(const VolumeGrid& grid, const Eigen::Vector3i& voxel) {
  return (voxel.array() == 0).any() || (voxel.array() == grid.size().array() - 1).any();
}

TEST(Cloud, LeavesTheBorderEmptyHoweverMuchItFills) {
  CloudOptions options = small_cloud();
  options.coverage = 1;
  options.puffs = 64;
  const VolumeGrid grid = make_cloud(options);
  for_each_voxel({Eigen::Vector3i::Zero(), grid.size() - Eigen::Vector3i::Ones()},
                 [&](const Eigen::Vector3i& voxel) {
                   if (on_border(grid, voxel)) ASSERT_EQ(*grid.voxels.at(voxel), 0) << voxel;
                 });
}

TEST(Cloud, IsTheSameAtAnyNumberOfThreads) {
  const VolumeGrid many = make_cloud(small_cloud());
  const ThreadLimit one(1);
  EXPECT_EQ(make_cloud(small_cloud()).voxels, many.voxels);
}

TEST(Cloud, DependsOnTheSeedAndFillsMoreWithCoverage) {
  CloudOptions options = small_cloud();
  const auto sum = [&] {
    const std::vector<float> values = testing::dense_values(make_cloud(options).voxels);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  const double first = sum();
  options.seed = 1;
  EXPECT_NE(sum(), first);
  options.seed = 0;
  options.coverage = 0.9f;
  EXPECT_GT(sum(), 1.3 * first);
}

TEST(Cloud, RefusesOptionsOutOfRange) {
  CloudOptions options;
  options.resolution = 8;
  EXPECT_THROW(make_cloud(options), Misuse);
  options = {};
  options.edge = 0;
  EXPECT_THROW(make_cloud(options), Misuse);
}

}  // namespace
}  // namespace waylight
