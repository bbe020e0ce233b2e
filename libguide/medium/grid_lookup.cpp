#include "libguide/medium/grid_lookup.h"

namespace waylight {
namespace {

const float* nearest(const VoxelBricks& voxels, const Vec3& x) {
  return voxels.at(x.cast<int>().cwiseMin((voxels.size().array() - 1).matrix()));
}

// read(p) is the value of the voxel at p, which is `channels` floats.
template <int channels, typename Value, typename Read>
Value interpolate(const VoxelBricks& voxels, const Vec3& x, const Read& read) {
  const Vec3 centred = x.array() - 0.5f, low = centred.array().floor(), share = centred - low;
  const auto mix = [](const Value& a, const Value& b, float t) { return Value(a + (b - a) * t); };
  const auto line = [&](const float* p) { return mix(read(p), read(p + channels), share.x()); };
  const auto plane = [&](const float* p) {
    return mix(line(p), line(p + channels * VoxelBricks::kRow), share.y());
  };
  const float* first = voxels.at(low.cast<int>());
  return mix(plane(first), plane(first + channels * VoxelBricks::kSlice), share.z());
}

}  // namespace

float GridLookup::at(const Vec3& world) const {
  const Vec3 voxel = to_voxels_.point(world);
  const VoxelBricks& voxels = grid_->voxels;
  if (!holds(voxel)) return 0;
  if (grid_->nearest) return *nearest(voxels, voxel);
  return interpolate<1, float>(voxels, voxel, [](const float* p) { return *p; });
}

Color GridLookup::color_at(const Vec3& world) const {
  if (scalar()) return Color::Constant(at(world));
  const Vec3 voxel = to_voxels_.point(world);
  const VoxelBricks& voxels = grid_->voxels;
  if (!holds(voxel)) return Color::Zero();
  const auto read = [](const float* p) { return Color(Eigen::Map<const Color>(p)); };
  if (grid_->nearest) return read(nearest(voxels, voxel));
  return interpolate<3, Color>(voxels, voxel, read);
}

}  // namespace waylight
