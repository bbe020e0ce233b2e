#include "formats/volume_checks.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

class CheckedVoxels : public VoxelSource {
 public:
  CheckedVoxels(const std::string& path, int channels, const VoxelSource& voxels)
      : path_(path), channels_(channels), voxels_(voxels) {}

  bool constant(const VoxelBox& box, float* value) const override {
    if (!voxels_.constant(box, value)) return false;
    check({box.first, box.first}, value);
    return true;
  }
  void read(const VoxelBox& box, float* values) const override {
    constexpr size_t kMaxBricks = size_t{1} << 22;
    if (++bricks_ > kMaxBricks)
      fail("\"{}\": more than 2^22 bricks of 8^3 voxels are not empty; crop or resample the grid",
           path_);
    voxels_.read(box, values);
    check(box, values);
  }

 private:
  void check(const VoxelBox& box, float* values) const {
    for_each_voxel(box, [&](const Eigen::Vector3i& voxel) {
      for (int c = 0; c < channels_; ++c, ++values) {
        if (!std::isfinite(*values))
          fail("\"{}\": the value of voxel {}, {}, {} is not finite", path_, voxel.x(), voxel.y(),
               voxel.z());
        *values = std::max(*values, 0.0f);
      }
    });
  }

  const std::string& path_;
  int channels_;
  const VoxelSource& voxels_;
  mutable size_t bricks_ = 0;  // read
};

}  // namespace

void check_volume_size(const std::string& path, int64_t x, int64_t y, int64_t z) {
  constexpr int64_t kMaxAxis = int64_t{1} << 22, kMaxNodes = int64_t{1} << 24;
  if (x <= 0 || y <= 0 || z <= 0) fail("\"{}\": the grid of {} x {} x {} is empty", path, x, y, z);
  const auto nodes = [](int64_t voxels) { return (voxels >> VoxelBricks::kNodeShift) + 1; };
  if (std::max({x, y, z}) > kMaxAxis || nodes(x) * nodes(y) * nodes(z) > kMaxNodes)
    fail(
        "\"{}\": {} x {} x {} voxels are more than 2^22 along an axis, or more than 2^24 blocks of "
        "128^3; crop or resample the grid",
        path, x, y, z);
}

VoxelBricks checked_bricks(const std::string& path, const Eigen::Vector3i& size, int channels,
                           const VoxelSource& voxels) {
  return {size, channels, CheckedVoxels(path, channels, voxels)};
}

}  // namespace waylight
