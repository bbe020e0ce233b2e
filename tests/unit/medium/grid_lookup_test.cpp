#include "libguide/medium/grid_lookup.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

// Two values along x, in the box [0, 4] x [0, 1] x [0, 1] of the world.
GridLookup lookup(bool values_on_sides) {
  VolumeGrid grid;
  const std::vector<float> values = {2, 6};
  grid.voxels = VoxelBricks({2, 1, 1}, 1, values);
  grid.grid_to_world.diagonal() = Eigen::Vector4f(4, 1, 1, 1);
  grid.values_on_sides = values_on_sides;
  return GridLookup(std::make_shared<const VolumeGrid>(std::move(grid)));
}

float at(const GridLookup& grid, float x) { return grid.at({x, 0.3f, 0.9f}); }

TEST(GridLookup, ValuesAtTheCentresOfVoxelsAreConstantOverTheOuterHalf) {
  const GridLookup grid = lookup(false);
  EXPECT_EQ(at(grid, 0), 2);
  EXPECT_EQ(at(grid, 1), 2);
  EXPECT_FLOAT_EQ(at(grid, 2), 4);
  EXPECT_EQ(at(grid, 3), 6);
  EXPECT_EQ(at(grid, 4), 6);
}

TEST(GridLookup, ValuesOnTheSidesAreInterpolatedAllAlong) {
  const GridLookup grid = lookup(true);
  EXPECT_FLOAT_EQ(at(grid, 0), 2);
  EXPECT_FLOAT_EQ(at(grid, 1), 3);
  EXPECT_FLOAT_EQ(at(grid, 2), 4);
  EXPECT_FLOAT_EQ(at(grid, 4), 6);
}

TEST(GridLookup, NothingIsOutsideOfTheBox) {
  for (const bool on_sides : {false, true}) {
    const GridLookup grid = lookup(on_sides);
    EXPECT_EQ(at(grid, -0.01f), 0);
    EXPECT_EQ(at(grid, 4.01f), 0);
    EXPECT_EQ(grid.at({1, 1.01f, 0.5f}), 0);
  }
}

}  // namespace
}  // namespace waylight
