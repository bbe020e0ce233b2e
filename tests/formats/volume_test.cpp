// Volume grids written and read again.

#include <thread>

#include "common/small_media.h"
#include "formats/temporary_files.h"
#include "formats/volume_io.h"

namespace waylight {
namespace {

using namespace testing;

using Volumes = TemporaryFiles;

// Two voxels of value in a box of nothing, in a world where the axes differ in length and turn.
VolumeGrid two_voxels() {
  VolumeGrid grid;
  std::vector<float> values(size_t{7} * 5 * 9);
  values[(4 * 5 + 2) * 7 + 3] = 0.25f;
  values[(5 * 5 + 2) * 7 + 3] = 1;
  grid.voxels = VoxelBricks({7, 5, 9}, 1, values);
  const Eigen::AngleAxisf turn(0.4f, Vec3(1, 2, 3).normalized());
  grid.grid_to_world.topLeftCorner<3, 3>() = turn.matrix() * Vec3(2, 3, 4).asDiagonal();
  grid.grid_to_world.topRightCorner<3, 1>() = Vec3(-1, 5, 0.5f);
  return grid;
}

Vec3 center_of(const VolumeGrid& grid, const Eigen::Vector3i& voxel) {
  const Vec3 p =
      (voxel.cast<float>() + Vec3::Constant(0.5f)).cwiseQuotient(grid.size().cast<float>());
  return (grid.grid_to_world * p.homogeneous()).head<3>();
}

TEST_F(Volumes, AVdbGridComesBackCroppedToWhatItHolds) {
  const VolumeGrid grid = two_voxels();
  write_vdb(path("two.vdb"), grid, "density");
  const VolumeGrid read = read_vdb(path("two.vdb"), "density");
  EXPECT_EQ(read.size(), Eigen::Vector3i(1, 1, 2));
  EXPECT_EQ(dense_values(read.voxels), (std::vector<float>{0.25f, 1}));
  EXPECT_TRUE(center_of(read, {0, 0, 0}).isApprox(center_of(grid, {3, 2, 4}), 1e-5f));
  EXPECT_TRUE(center_of(read, {0, 0, 1}).isApprox(center_of(grid, {3, 2, 5}), 1e-5f));
}

TEST_F(Volumes, AVdbFileCutAnywhereIsRefused) {
  write_vdb(path("whole.vdb"), two_voxels(), "density");
  const std::string bytes = read_whole_file(path("whole.vdb"));
  for (size_t length = 0; length < bytes.size(); ++length) {
    put("cut.vdb", bytes.substr(0, length));
    EXPECT_THROW(read_vdb(path("cut.vdb"), "density"), Error) << length << " bytes";
  }
}

TEST_F(Volumes, AnEmptyVdbGridComesBackAsOneVoxelOfNothing) {
  VolumeGrid grid = two_voxels();
  grid.voxels.scale(0);
  write_vdb(path("empty.vdb"), grid, "density");
  EXPECT_EQ(dense_values(read_vdb(path("empty.vdb"), "").voxels), std::vector<float>{0});
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
  grid.voxels = VoxelBricks({1, 1, 1}, 3, std::vector<float>{1, 2, 3});
  EXPECT_TRUE(mentions(error_of([&] { write_vdb(path("a.vdb"), grid, "density"); }), "3 channels"));
  EXPECT_EQ(file_count(), 0u);
}

// A .vol file of version 3, of `count` values in one row.
std::string vol_bytes(int type, int channels, const std::vector<float>& values, int count) {
  std::string bytes = "VOL\3";
  const auto put = [&](const auto& v) {
    bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  };
  for (const int32_t v : {type, count / channels, 1, 1, channels}) put(v);
  for (const float v : {0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f}) put(v);
  for (const float v : values)
    if (type == 1)
      put(v);
    else
      put(static_cast<uint8_t>(static_cast<int>(v)));
  return bytes;
}

TEST_F(Volumes, AVolFileHoldsFloatsOrBytesInOneOrThreeChannels) {
  const auto read = [&](int type, int channels) {
    const std::string file = put("a.vol", vol_bytes(type, channels, {0, 51, 255, -3, 5, 6}, 6));
    return dense_values(read_vol(file).voxels);
  };
  for (const int channels : {1, 3}) {
    EXPECT_EQ(read(1, channels), (std::vector<float>{0, 51, 255, 0, 5, 6}));
    EXPECT_EQ(read(3, channels)[1], 0.2f);
    EXPECT_EQ(read(3, channels)[2], 1);
  }
}

TEST_F(Volumes, AVolFileThatIsShortOrNotFiniteOrTooLargeIsRefused) {
  const auto refusal = [&](const std::vector<float>& values, int count) {
    const std::string file = put("bad.vol", vol_bytes(1, 1, values, count));
    return error_of([&] { read_vol(file); });
  };
  EXPECT_TRUE(mentions(refusal({1, 2, 3}, 4), "truncated"));
  EXPECT_TRUE(mentions(refusal({1, NAN, 3}, 3), "voxel 1, 0, 0 is not finite"));
  EXPECT_TRUE(mentions(refusal({1, 2, INFINITY}, 3), "voxel 2, 0, 0 is not finite"));
  EXPECT_TRUE(mentions(refusal({1}, 1 << 23), "2^22 along an axis"));
  EXPECT_TRUE(mentions(refusal({1}, 0), "empty"));
}

TEST_F(Volumes, AFolderThatIsMissingIsNamed) {
  const std::string message =
      error_of([&] { write_vdb(path("no/a.vdb"), two_voxels(), "density"); });
  EXPECT_TRUE(mentions(message, "a.vdb")) << message;
}

}  // namespace
}  // namespace waylight
