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

class VolVoxels : public VoxelSource {
 public:
  VolVoxels(const VolHeader& header, ByteReader& bytes)
      : header_(header),
        values_(bytes.take(size_t(header.x) * header.y * header.z * header.channels * width())) {}

  bool constant(const VoxelBox& /*box*/, float* /*value*/) const override { return false; }
  void read(const VoxelBox& box, float* values) const override {
    const size_t count = size_t(box.extent().x()) * header_.channels;
    for (int z = box.first.z(); z <= box.last.z(); ++z)
      for (int y = box.first.y(); y <= box.last.y(); ++y, values += count)
        read_row((size_t(z) * header_.y + y) * header_.x + box.first.x(), count, values);
  }

 private:
  size_t width() const { return header_.type == kFloat32 ? sizeof(float) : 1; }
  void read_row(size_t voxel, size_t count, float* values) const {
    const char* row = &values_[voxel * header_.channels * width()];
    if (header_.type == kFloat32)
      std::memcpy(values, row, count * sizeof(float));
    else
      std::transform(row, row + count, values,
                     [](char byte) { return float(static_cast<uint8_t>(byte)) / 255; });
  }

  VolHeader header_;
  std::string_view values_;
};

}  // namespace

VolumeGrid read_vol(const std::string& path) {
  const std::string file = read_whole_file(path);
  ByteReader bytes(file, path);
  const VolHeader header = read_header(bytes);
  const Mat4 to_world = box_to_world(header, path);
  const VolVoxels voxels(header, bytes);
  const Eigen::Vector3i size(header.x, header.y, header.z);
  return {checked_bricks(path, size, header.channels, voxels), false, to_world};
}

}  // namespace waylight
