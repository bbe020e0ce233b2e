#include "formats/file_bytes.h"
#include "formats/volume_checks.h"
#include "formats/volume_io.h"

namespace waylight {
namespace {

enum VolType : int32_t { kFloat32 = 1, kUint8 = 3 };

struct VolHeader {
  int32_t type, x, y, z, channels;
  float box[6];  // min, max
};
static_assert(sizeof(VolHeader) == 44);

Mat4 box_to_world(const VolHeader& header, const std::string& path) {
  Mat4 to_world = Mat4::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    const float low = header.box[axis], size = header.box[axis + 3] - low;
    if (!std::isfinite(low) || !std::isfinite(size) || !(size > 0))
      fail("\"{}\": its box has no extent, or is not finite, along axis {}", path, axis);
    to_world(axis, axis) = size;
    to_world(axis, 3) = low;
  }
  return to_world;
}

VolHeader read_header(ByteReader& bytes) {
  const std::string& path = bytes.path();
  if (bytes.remaining() < 4 || bytes.take(3) != "VOL") fail("\"{}\": is not a .vol file", path);
  const int version = bytes.read<uint8_t>();
  if (version != 3) fail("\"{}\": version {} of .vol is unknown (known: 3)", path, version);
  const VolHeader header = bytes.read<VolHeader>();
  if (header.type != kFloat32 && header.type != kUint8)
    fail("\"{}\": value type {} is not supported (1: float32, 3: uint8)", path, header.type);
  if (header.channels != 1 && header.channels != 3)
    fail("\"{}\": {} channels are not supported (1 or 3)", path, header.channels);
  check_volume_size(path, header.x, header.y, header.z);
  return header;
}

}  // namespace

VolumeGrid read_vol(const std::string& path) {
  const std::string file = read_whole_file(path);
  ByteReader bytes(file, path);
  const VolHeader header = read_header(bytes);
  VolumeGrid grid;
  grid.size = {header.x, header.y, header.z};
  grid.channels = header.channels;
  grid.grid_to_world = box_to_world(header, path);
  const size_t count = size_t(header.x) * header.y * header.z * header.channels;
  if (header.type == kFloat32) {
    const std::string_view data = bytes.take(count * sizeof(float));
    grid.values.resize(count);
    std::memcpy(grid.values.data(), data.data(), data.size());
  } else {
    for (char byte : bytes.take(count))
      grid.values.push_back(static_cast<float>(static_cast<uint8_t>(byte)) / 255);
  }
  finish_volume(grid, path);
  return grid;
}

void check_volume_size(const std::string& path, int64_t x, int64_t y, int64_t z) {
  constexpr int64_t kMaxVoxels = int64_t{1} << 30;
  if (x <= 0 || y <= 0 || z <= 0) fail("\"{}\": the grid of {} x {} x {} is empty", path, x, y, z);
  if (x > kMaxVoxels || y > kMaxVoxels || x * y > kMaxVoxels || z > kMaxVoxels / (x * y))
    fail("\"{}\": {} x {} x {} voxels are more than 2^30; crop or resample the grid", path, x, y,
         z);
}

void finish_volume(VolumeGrid& grid, const std::string& path) {
  for (size_t i = 0; i < grid.values.size(); ++i) {
    if (!std::isfinite(grid.values[i]))
      fail("\"{}\": the value of voxel {} is not finite", path, i / grid.channels);
    grid.values[i] = std::max(grid.values[i], 0.0f);
  }
}

}  // namespace waylight
