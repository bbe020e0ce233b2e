// Bricks against the dense array that they are made of.

#include "libguide/medium/voxel_bricks.h"

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "libguide/base/sampler.h"
#include "libguide/medium/extinction_blocks.h"

namespace waylight {
namespace {

using Size = Eigen::Vector3i;

struct Dense {
  Size size;
  int channels;
  std::vector<float> values;

  // Of the nearest voxel of the grid.
  float at(const Size& voxel, int channel) const {
    const Size i = voxel.cwiseMax(0).cwiseMin((size.array() - 1).matrix());
    return values[((size_t(i.z()) * size.y() + i.y()) * size.x() + i.x()) * channels + channel];
  }
  // Trilinear in double precision; x in voxels.
  double trilinear(const Eigen::Vector3d& x, int channel) const {
    const Eigen::Vector3d low = (x.array() - 0.5).floor(), share = x.array() - 0.5 - low.array();
    double sum = 0;
    for_each_voxel({Size::Zero(), Size::Ones()}, [&](const Size& corner) {
      const Eigen::Array3d far = corner.cast<double>();
      const double weight = (far * share.array() + (1 - far) * (1 - share.array())).prod();
      sum += weight * at(low.cast<int>() + corner, channel);
    });
    return sum;
  }
};

// Noise in the half of low x, one value elsewhere.
Dense half_noise(const Size& size, int channels) {
  Dense dense{size, channels, {}};
  for_each_voxel({Size::Zero(), (size.array() - 1).matrix()}, [&](const Size& voxel) {
    for (int c = 0; c < channels; ++c) {
      Sampler random(c, voxel.x(), voxel.y() * 1000 + voxel.z());
      dense.values.push_back(2 * voxel.x() < size.x() ? random.next() : 0.5f + c);
    }
  });
  return dense;
}

VoxelBricks bricks_of(const Dense& dense) {
  return {dense.size, dense.channels, std::span<const float>(dense.values)};
}

std::shared_ptr<const VolumeGrid> grid_of(const Dense& dense, bool nearest = false) {
  VolumeGrid grid{bricks_of(dense), nearest};
  grid.grid_to_world.diagonal().head<3>() = dense.size.cast<float>();
  return std::make_shared<VolumeGrid>(std::move(grid));
}

// On both sides of the borders of bricks and of nodes, in all sizes of the last brick.
const std::vector<Size> kSizes = {{1, 1, 1},   {7, 8, 9},    {15, 16, 17}, {23, 1, 40},
                                  {130, 9, 5}, {127, 3, 20}, {4, 128, 12}, {6, 10, 260}};

TEST(VoxelBricks, HoldEveryVoxelOfTheDenseArray) {
  for (const Size& size : kSizes)
    for (const int channels : {1, 3}) {
      const Dense dense = half_noise(size, channels);
      const VoxelBricks bricks = bricks_of(dense);
      EXPECT_EQ(testing::dense_values(bricks), dense.values) << size.transpose();
    }
}

TEST(VoxelBricks, HaveTheNextVoxelsBesideEachAndRepeatTheOutermost) {
  for (const Size& size : kSizes) {
    const Dense dense = half_noise(size, 3);
    const VoxelBricks bricks = bricks_of(dense);
    for_each_voxel({-Size::Ones(), (size.array() - 1).matrix()}, [&](const Size& voxel) {
      for_each_voxel({Size::Zero(), Size::Ones()}, [&](const Size& next) {
        const int step = next.dot(Size(1, VoxelBricks::kRow, VoxelBricks::kSlice));
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(bricks.at(voxel)[3 * step + c], dense.at(voxel + next, c)) << voxel.transpose();
      });
    });
  }
}

// A point in or near the grid, in voxels; some on the borders of voxels, some on those of bricks.
Vec3 some_point(const Size& size, int i) {
  Sampler random(3, 4, i);
  Vec3 x(random.next(), random.next(), random.next());
  x = (x.array() * 1.1f - 0.05f) * size.cast<float>().array();
  if (i % 4 == 1) x = x.array().round();
  if (i % 4 == 2) x = (x.array() / 8).round() * 8;
  if (i % 4 == 3) x = (x.array() / 8).round() * 8 - 0.5f;
  return x;
}

bool inside(const Vec3& x, const Size& size) {
  return (x.array() >= 0).all() && (x.array() <= size.cast<float>().array()).all();
}

TEST(GridLookup, IsTrilinearInTheDenseArrayAndNothingOutside) {
  for (const Size& size : kSizes)
    for (const int channels : {1, 3}) {
      const Dense dense = half_noise(size, channels);
      const GridLookup lookup(grid_of(dense));
      for (int i = 0; i < 2000; ++i) {
        const Vec3 x = some_point(size, i);
        const Color value = lookup.color_at(x);
        for (int c = 0; c < channels; ++c)
          ASSERT_NEAR(value[c], inside(x, size) ? dense.trilinear(x.cast<double>(), c) : 0, 1e-4f)
              << x.transpose() << " of " << size.transpose();
      }
    }
}

TEST(GridLookup, OfTheNearestVoxelIsThatOfTheDenseArray) {
  for (const Size& size : kSizes) {
    const Dense dense = half_noise(size, 3);
    const GridLookup lookup(grid_of(dense, true));
    for (int i = 0; i < 2000; ++i) {
      const Vec3 x = some_point(size, 4 * i);
      const Color value = lookup.color_at(x);
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(value[c], inside(x, size) ? dense.at(x.cast<int>(), c) : 0) << x.transpose();
    }
  }
}

TEST(VoxelBricks, OfOneValueAreStoredOnceForAll) {
  Dense dense{{300, 70, 70}, 1, std::vector<float>(size_t{300} * 70 * 70, 0.25f)};
  EXPECT_EQ(bricks_of(dense).stored_bricks(), 1u);
  dense.values[(size_t{35} * 70 + 35) * 300 + 150] = 1;  // in the middle of a brick
  EXPECT_EQ(bricks_of(dense).stored_bricks(), 2u);
  dense.values.back() = 0.5f;
  EXPECT_EQ(bricks_of(dense).stored_bricks(), 3u);
}

TEST(VoxelBricks, VisitEveryVoxelOfABoxOnce) {
  const Size size(150, 20, 30);
  const Dense dense = half_noise(size, 1);
  const VoxelBricks bricks = bricks_of(dense);
  for (const VoxelBox& box : {VoxelBox{{0, 0, 0}, {149, 19, 29}}, VoxelBox{{5, 3, 7}, {133, 3, 16}},
                              VoxelBox{{126, 6, 6}, {128, 8, 8}}}) {
    std::vector<float> expected, visited;
    for_each_voxel(box, [&](const Size& voxel) { expected.push_back(dense.at(voxel, 0)); });
    int64_t visits = 0;
    bricks.visit(box, [&](const float* value, int64_t count) {
      visited.insert(visited.end(), count, *value);
      ++visits;
    });
    std::sort(expected.begin(), expected.end());
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, expected);
    EXPECT_LE(visits, box.count());
  }
}

TEST(VoxelBricks, RangeAndScaleTakeInAllChannels) {
  VoxelBricks bricks(Size(2, 1, 1), 3, std::vector<float>{1, 2, 3, 4, 5, 0.5f});
  bricks.scale(2);
  EXPECT_EQ(testing::dense_values(bricks), (std::vector<float>{2, 4, 6, 8, 10, 1}));
  EXPECT_EQ(bricks.range().least, 1);
  EXPECT_EQ(bricks.range().most, 10);
}

// One value over a box without end but for one brick.
class OneBrick : public VoxelSource {
 public:
  explicit OneBrick(const Size& filled) : filled_(filled) {}
  bool constant(const VoxelBox& box, float* value) const override {
    *value = 0;
    return ((box.first.array() > filled_.array()) || (box.last.array() < filled_.array())).any();
  }
  void read(const VoxelBox& box, float* values) const override {
    ++reads;
    for_each_voxel(box, [&](const Size& voxel) { *values++ = voxel == filled_ ? 1 : 0; });
  }
  mutable int reads = 0;

 private:
  Size filled_;
};

TEST(VoxelBricks, OfEmptySpaceAreNotRead) {
  const OneBrick source({10003, 2003, 9003});
  const VoxelBricks bricks({16000, 16000, 16000}, 1, source);
  EXPECT_EQ(source.reads, 1);
  EXPECT_EQ(bricks.stored_bricks(), 2u);
  EXPECT_EQ(*bricks.at({10003, 2003, 9003}), 1);
  EXPECT_EQ(bricks.range().most, 1);
}

TEST(ExtinctionBlocks, OfAWideGridAreFewAndMissNothing) {
  const Size filled(10003, 2003, 9003);
  const VolumeGrid grid{VoxelBricks(Size::Constant(16000), 1, OneBrick(filled))};
  const ExtinctionBlocks blocks(grid, 3);
  EXPECT_LE(blocks.counts().cast<int64_t>().prod(), int64_t{1} << 21);
  int with_extinction = 0;
  for_each_voxel({Size::Zero(), (blocks.counts().array() - 1).matrix()},
                 [&](const Size& block) { with_extinction += blocks.at(block).most > 0; });
  EXPECT_EQ(with_extinction, 1);
  const ExtinctionBounds bounds = blocks.at((filled.array() / blocks.side()).matrix());
  EXPECT_EQ(bounds.least, 0);
  EXPECT_FLOAT_EQ(bounds.mean, 3 / std::pow(blocks.side() + 2.0f, 3.0f));
}

}  // namespace
}  // namespace waylight
