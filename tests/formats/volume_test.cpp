// Volume grids written and read again.

#include <thread>

#include "formats/temporary_files.h"
#include "formats/volume_io.h"

namespace waylight {
namespace {

using namespace testing;

using Volumes = TemporaryFiles;

// Two voxels of value in a box of nothing, in a world where the axes differ in length and turn.
VolumeGrid two_voxels() {
  VolumeGrid grid;
  grid.size = {7, 5, 9};
  grid.values.assign(size_t{7} * 5 * 9, 0.0f);
  grid.values[(4 * 5 + 2) * 7 + 3] = 0.25f;
  grid.values[(5 * 5 + 2) * 7 + 3] = 1;
  const Eigen::AngleAxisf turn(0.4f, Vec3(1, 2, 3).normalized());
  grid.grid_to_world.topLeftCorner<3, 3>() = turn.matrix() * Vec3(2, 3, 4).asDiagonal();
  grid.grid_to_world.topRightCorner<3, 1>() = Vec3(-1, 5, 0.5f);
  return grid;
}

Vec3 center_of(const VolumeGrid& grid, const Eigen::Vector3i& voxel) {
  const Vec3 p =
      (voxel.cast<float>() + Vec3::Constant(0.5f)).cwiseQuotient(grid.size.cast<float>());
  return (grid.grid_to_world * p.homogeneous()).head<3>();
}

TEST_F(Volumes, AVdbGridComesBackCroppedToWhatItHolds) {
  const VolumeGrid grid = two_voxels();
  write_vdb(path("two.vdb"), grid, "density");
  const VolumeGrid read = read_vdb(path("two.vdb"), "density");
  EXPECT_EQ(read.size, Eigen::Vector3i(1, 1, 2));
  EXPECT_EQ(read.values, (std::vector<float>{0.25f, 1}));
  EXPECT_TRUE(center_of(read, {0, 0, 0}).isApprox(center_of(grid, {3, 2, 4}), 1e-5f));
  EXPECT_TRUE(center_of(read, {0, 0, 1}).isApprox(center_of(grid, {3, 2, 5}), 1e-5f));
}

TEST_F(Volumes, AnEmptyVdbGridComesBackAsOneVoxelOfNothing) {
  VolumeGrid grid = two_voxels();
  grid.values.assign(grid.values.size(), 0.0f);
  write_vdb(path("empty.vdb"), grid, "density");
  EXPECT_EQ(read_vdb(path("empty.vdb"), "").values, std::vector<float>{0});
}

// OpenVDB names every file by the clock, which counts seconds.
TEST_F(Volumes, EqualVdbGridsAreEqualBytes) {
  write_vdb(path("a.vdb"), two_voxels(), "density", {{"waylight.tool", "test"}});
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_vdb(path("b.vdb"), two_voxels(), "density", {{"waylight.tool", "test"}});
  write_vdb(path("c.vdb"), two_voxels(), "smoke", {{"waylight.tool", "test"}});
  const std::string a = read_whole_file(path("a.vdb"));
  EXPECT_EQ(a, read_whole_file(path("b.vdb")));
  EXPECT_NE(a, read_whole_file(path("c.vdb")));
  constexpr size_t kUuid = 8 + 3 * 4 + 1;  // after magic number, versions and a flag
  EXPECT_EQ(a.substr(kUuid, 19), "00000000-0000-0000-");
}

TEST_F(Volumes, OnlyGridsOfOneChannelAreWritten) {
  VolumeGrid grid = two_voxels();
  grid.channels = 3;
  EXPECT_TRUE(mentions(error_of([&] { write_vdb(path("a.vdb"), grid, "density"); }), "3 channels"));
  EXPECT_EQ(file_count(), 0u);
}

TEST_F(Volumes, AFolderThatIsMissingIsNamed) {
  const std::string message =
      error_of([&] { write_vdb(path("no/a.vdb"), two_voxels(), "density"); });
  EXPECT_TRUE(mentions(message, "a.vdb")) << message;
}

}  // namespace
}  // namespace waylight
