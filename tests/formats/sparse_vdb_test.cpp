// Grids that OpenVDB made, against its own accessor. Beside formats/volume_vdb.cpp the only file
// that sees OpenVDB.

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include "common/small_media.h"
#include "formats/temporary_files.h"
#include "formats/volume_io.h"
#include "libguide/base/sampler.h"
#include "libguide/medium/medium_tracker.h"

namespace waylight {
namespace {

using namespace testing;

class SparseVdb : public TemporaryFiles {
 protected:
  template <typename Grid>
  std::string write(const Grid& grid) const {
    grid->setName("density");
    openvdb::io::File(path("grid.vdb")).write(openvdb::GridCPtrVec{grid});
    return path("grid.vdb");
  }
  template <typename Grid>
  VolumeGrid written_and_read(const Grid& grid) const {
    return read_vdb(write(grid), "");
  }
  template <typename Grid>
  std::string refusal(const Grid& grid) const {
    return error_of([&] { written_and_read(grid); });
  }
};

openvdb::FloatGrid::Ptr empty_grid(float background = 0) {
  openvdb::initialize();
  return openvdb::FloatGrid::create(background);
}

// Noise within a ball.
template <typename Grid>
void add_ball(const Grid& grid, const openvdb::Coord& center, int radius) {
  auto voxels = grid->getAccessor();
  for (int z = -radius; z <= radius; ++z)
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x)
        if (x * x + y * y + z * z <= radius * radius) {
          Sampler random(x, y, z);
          voxels.setValue(center + openvdb::Coord(x, y, z),
                          typename Grid::element_type::ValueType(0.1f + random.next()));
        }
}

openvdb::FloatGrid::Ptr far_apart_balls() {
  const openvdb::FloatGrid::Ptr grid = empty_grid();
  add_ball(grid, {-5, 13, 7}, 20);
  add_ball(grid, {2300, 2324, -2309}, 17);  // at a distance of 4000
  return grid;
}

openvdb::CoordBBox box_of(const openvdb::GridBase& grid) {
  return grid.evalActiveVoxelBoundingBox();
}

Eigen::Vector3i voxel_of(const openvdb::Coord& index, const openvdb::CoordBBox& box) {
  const openvdb::Coord i = index - box.min();
  return {i.x(), i.y(), i.z()};
}

// Around the corners of the box and the balls, and anywhere.
openvdb::Coord some_index(const openvdb::CoordBBox& box, int i) {
  Sampler random(1, 2, i);
  const auto along = [&](int axis) {
    const float u = random.next();
    if (i % 3 == 0) return box.min()[axis] + static_cast<int>(u * float(box.dim()[axis]));
    const int within = static_cast<int>(u * 45);
    return i % 3 == 1 ? box.min()[axis] + within : box.max()[axis] - within;
  };
  const int x = along(0), y = along(1), z = along(2);
  // The second ball is at the far end of x and y, and the near one of z.
  return {x, y,
          i % 3 == 1   ? box.max().z() - (z - box.min().z())
          : i % 3 == 2 ? box.min().z() + (box.max().z() - z)
                       : z};
}

template <typename Grid>
void expect_every_looked_at_voxel(const Grid& grid, const VolumeGrid& volume) {
  const openvdb::CoordBBox box = box_of(*grid);
  auto voxels = grid->getConstAccessor();
  int filled = 0;
  for (int i = 0; i < 60000; ++i) {
    const openvdb::Coord index = some_index(box, i);
    const float expected = std::max(float(voxels.getValue(index)), 0.0f);
    ASSERT_EQ(*volume.voxels.at(voxel_of(index, box)), expected) << index;
    filled += expected > 0;
  }
  EXPECT_GT(filled, 3000);
}

// Written in 16 bits to save space, as clouds often are.
TEST_F(SparseVdb, HalfGridsComeBackToThePrecisionOfHalf) {
  const openvdb::FloatGrid::Ptr grid = empty_grid();
  add_ball(grid, {0, 0, 0}, 6);
  const VolumeGrid whole = written_and_read(grid);
  grid->setSaveFloatAsHalf(true);
  const VolumeGrid half = written_and_read(grid);
  const std::vector<float> expected = dense_values(whole.voxels), read = dense_values(half.voxels);
  ASSERT_EQ(read.size(), expected.size());
  EXPECT_NE(read, expected);
  for (size_t i = 0; i < read.size(); ++i) EXPECT_NEAR(read[i], expected[i], 1e-3f * expected[i]);
}

TEST_F(SparseVdb, FarApartBallsHaveOpenVdbsValuesEverywhere) {
  const openvdb::FloatGrid::Ptr grid = far_apart_balls();
  expect_every_looked_at_voxel(grid, written_and_read(grid));
}

TEST_F(SparseVdb, FarApartBallsAreInterpolatedAsOpenVdbDoes) {
  const openvdb::FloatGrid::Ptr grid = far_apart_balls();
  const openvdb::CoordBBox box = box_of(*grid);
  const auto volume = std::make_shared<VolumeGrid>(written_and_read(grid));
  volume->grid_to_world =
      Mat4::Identity();  // to look up by voxels, which single precision resolves
  volume->grid_to_world.diagonal().head<3>() = volume->size().cast<float>();
  const GridLookup lookup(volume);
  auto voxels = grid->getConstAccessor();
  int filled = 0;
  for (int i = 0; i < 60000; ++i) {
    Sampler random(3, 4, i);
    const Vec3 x = voxel_of(some_index(box, i), box).cast<float>() +
                   Vec3(random.next(), random.next(), random.next());
    if ((x.array() < 0.5f).any() || (x.array() > volume->size().cast<float>().array() - 0.5f).any())
      continue;  // where the outermost voxels are repeated
    const openvdb::Vec3d at(x.x() - 0.5, x.y() - 0.5, x.z() - 0.5);
    const float expected = openvdb::tools::BoxSampler::sample(voxels, at + box.min().asVec3d());
    ASSERT_NEAR(lookup.at(x), expected, 3e-3f) << x.transpose();
    filled += expected > 0;
  }
  EXPECT_GT(filled, 3000);
}

TEST_F(SparseVdb, FarApartBallsUseLittleMemory) {
  const VolumeGrid volume = written_and_read(far_apart_balls());
  EXPECT_GT(volume.size().minCoeff(), 2000);       // 12.6 G voxels, 50 GB
  EXPECT_LT(volume.voxels.stored_bricks(), 700u);  // 2 MB
}

TEST_F(SparseVdb, RaysFlyThroughFarApartBallsAndTheSpaceBetween) {
  const auto volume = std::make_shared<VolumeGrid>(written_and_read(far_apart_balls()));
  const HeterogeneousMedium coefficients{std::shared_ptr<const VolumeGrid>(volume),
                                         Color(Color::Ones()), 10};
  const MediumTracker medium({"balls", coefficients, IsotropicPhase{}});
  for (const Vec3& center : {Vec3(-5, 13, 7), Vec3(2300, 2324, -2309)}) {
    const Vec3 direction = Vec3(1, 0.2f, -0.3f).normalized();
    Sampler sampler(1, 2, 3);
    const Ray towards{center - 60 * direction, direction};
    const Flight flight = medium.fly(towards, kInfinity, Color::Ones(), sampler);
    EXPECT_TRUE(flight.scattered);
    EXPECT_NEAR(flight.t, 41, 4);
    const Ray beside{center + Vec3(0, 0, 300), Vec3(1, 0, 0)};
    EXPECT_FALSE(medium.fly(beside, kInfinity, Color::Ones(), sampler).scattered);
  }
}

TEST_F(SparseVdb, TilesAndBackgroundAreValuesToo) {
  const openvdb::FloatGrid::Ptr grid = empty_grid(0.5f);
  grid->fill(openvdb::CoordBBox({-512, 0, 0}, {511, 255, 127}), 2);
  grid->fill(openvdb::CoordBBox({100, 70, 30}, {300, 120, 100}), 3);
  add_ball(grid, {400, 300, 60}, 20);
  const VolumeGrid volume = written_and_read(grid);
  expect_every_looked_at_voxel(grid, volume);
  EXPECT_LT(volume.voxels.stored_bricks(), 5000u);  // of 88,000
  EXPECT_EQ(*volume.voxels.at({512 + 100, 70, 30}), 3);
  EXPECT_EQ(*volume.voxels.at({512 + 99, 70, 30}), 2);
  EXPECT_EQ(*volume.voxels.at({10, 300, 60}), 0.5f);
}

TEST_F(SparseVdb, TheLargestTilesAreOneBrick) {
  const openvdb::FloatGrid::Ptr grid = empty_grid();
  grid->fill(openvdb::CoordBBox({-4096, 0, 0}, {4095, 4095, 4095}), 2);
  const VolumeGrid volume = written_and_read(grid);
  EXPECT_EQ(volume.size(), Eigen::Vector3i(8192, 4096, 4096));
  EXPECT_EQ(volume.voxels.stored_bricks(), 1u);
  EXPECT_EQ(*volume.voxels.at({8191, 17, 4095}), 2);
}

TEST_F(SparseVdb, DoublesAreReadLikeFloats) {
  openvdb::initialize();
  const auto grid = openvdb::DoubleGrid::create();
  add_ball(grid, {3, 4, 5}, 30);
  expect_every_looked_at_voxel(grid, written_and_read(grid));
}

TEST_F(SparseVdb, VectorsAreThreeChannels) {
  openvdb::initialize();
  const auto grid = openvdb::Vec3SGrid::create();
  grid->getAccessor().setValue({5, 6, 7}, {1, 2, 3});
  grid->getAccessor().setValue({900, 6, 7}, {4, 5, -6});
  const VolumeGrid volume = written_and_read(grid);
  EXPECT_EQ(volume.voxels.channels(), 3);
  EXPECT_EQ(volume.size(), Eigen::Vector3i(896, 1, 1));
  const auto value = [&](int x) { return Eigen::Map<const Vec3>(volume.voxels.at({x, 0, 0})); };
  EXPECT_EQ(value(0), Vec3(1, 2, 3));
  EXPECT_EQ(value(400), Vec3(0, 0, 0));
  EXPECT_EQ(value(895), Vec3(4, 5, 0));
}

TEST_F(SparseVdb, NegativeVoxelsAndTilesBecomeNothing) {
  const openvdb::FloatGrid::Ptr grid = empty_grid();
  add_ball(grid, {0, 0, 107}, 20);
  grid->getAccessor().setValue({3, 4, 112}, -1);
  grid->fill(openvdb::CoordBBox({128, 0, 0}, {255, 127, 127}), -2);
  const VolumeGrid volume = written_and_read(grid);
  expect_every_looked_at_voxel(grid, volume);
  EXPECT_EQ(volume.voxels.range().least, 0);
}

TEST_F(SparseVdb, ValuesThatAreNotFiniteAreRefusedWhereverTheyAre) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -kInfinity, kInfinity}) {
    openvdb::FloatGrid::Ptr grid = far_apart_balls();
    grid->getAccessor().setValue({2300, 2324, -2309}, bad);
    EXPECT_TRUE(mentions(refusal(grid), "voxel 2325, 2331, 17 is not finite")) << refusal(grid);
    grid = far_apart_balls();
    grid->fill(openvdb::CoordBBox({128, 128, -256}, {255, 255, -129}), bad);  // a tile
    EXPECT_TRUE(mentions(refusal(grid), "is not finite")) << bad;
  }
}

TEST_F(SparseVdb, ExtentsBeyondTheResolutionOfFloatsAreRefused) {
  const openvdb::FloatGrid::Ptr grid = empty_grid();
  grid->getAccessor().setValue({0, 0, 0}, 1);
  grid->getAccessor().setValue({1 << 23, 0, 0}, 1);
  EXPECT_TRUE(mentions(refusal(grid), "8388609 x 1 x 1 voxels")) << refusal(grid);
}

TEST_F(SparseVdb, ExtentsWhoseTableWouldNotFitAreRefused) {
  const openvdb::FloatGrid::Ptr grid = empty_grid();
  grid->getAccessor().setValue(openvdb::Coord(-(1 << 18)), 1);
  grid->getAccessor().setValue(openvdb::Coord(1 << 18), 1);
  EXPECT_TRUE(mentions(refusal(grid), "2^24 blocks")) << refusal(grid);
}

TEST_F(SparseVdb, ATruncatedFileIsRefused) {
  const std::string bytes = read_whole_file(write(far_apart_balls()));
  const std::string half = put("half.vdb", bytes.substr(0, bytes.size() / 2));
  EXPECT_TRUE(mentions(error_of([&] { read_vdb(half, ""); }), "half.vdb"));
}

// Their values are distances, and negative inside.
TEST_F(SparseVdb, LevelSetsAreRefused) {
  const openvdb::FloatGrid::Ptr grid = far_apart_balls();
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  EXPECT_TRUE(mentions(refusal(grid), "grid \"density\" is a level set")) << refusal(grid);
  EXPECT_TRUE(mentions(refusal(grid), "ls2fog")) << refusal(grid);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(refusal(grid), "no error");
}

}  // namespace
}  // namespace waylight
