#include "libguide/medium/grid_lookup.h"

namespace waylight {
namespace {

// Offsets of the two neighbours along an axis, in values, and the share of the second.
struct AxisLookup {
  size_t first, second;
  float share;
};

AxisLookup neighbours(float x, int size, size_t stride) {
  const float centred = x - 0.5f;
  const float low = std::floor(centred);
  const int i = static_cast<int>(low);
  const auto offset = [&](int k) {
    return static_cast<size_t>(std::clamp(k, 0, size - 1)) * stride;
  };
  return {offset(i), offset(i + 1), centred - low};
}

bool inside(const Vec3& x, const Eigen::Vector3i& size) {
  return (x.array() >= 0).all() && (x.array() <= size.cast<float>().array()).all();
}

size_t nearest(const VolumeGrid& grid, const Vec3& x) {
  const Eigen::Vector3i i = x.cast<int>().cwiseMin(grid.size - Eigen::Vector3i::Ones());
  return (size_t(i.z()) * grid.size.y() + i.y()) * grid.size.x() + i.x();
}

// value(offset) of one voxel, which is `channels` values.
template <typename Value, typename Read>
Value interpolate(const VolumeGrid& grid, const Vec3& voxel, const Read& value) {
  const size_t c = grid.channels, row = c * grid.size.x(), slice = row * grid.size.y();
  const AxisLookup x = neighbours(voxel.x(), grid.size.x(), c);
  const AxisLookup y = neighbours(voxel.y(), grid.size.y(), row);
  const AxisLookup z = neighbours(voxel.z(), grid.size.z(), slice);
  const auto mix = [](const Value& a, const Value& b, float t) { return Value(a + (b - a) * t); };
  const auto line = [&](size_t at) {
    return mix(value(at + x.first), value(at + x.second), x.share);
  };
  const auto plane = [&](size_t at) {
    return mix(line(at + y.first), line(at + y.second), y.share);
  };
  return mix(plane(z.first), plane(z.second), z.share);
}

}  // namespace

float GridLookup::at(const Vec3& world) const {
  const Vec3 voxel = to_voxels_.point(world);
  if (!inside(voxel, grid_->size)) return 0;
  const float* values = grid_->values.data();
  if (grid_->nearest) return values[nearest(*grid_, voxel)];
  return interpolate<float>(*grid_, voxel, [&](size_t i) { return values[i]; });
}

Color GridLookup::color_at(const Vec3& world) const {
  if (scalar()) return Color::Constant(at(world));
  const Vec3 voxel = to_voxels_.point(world);
  if (!inside(voxel, grid_->size)) return Color::Zero();
  const float* values = grid_->values.data();
  const auto read = [&](size_t i) { return Color(Eigen::Map<const Color>(values + i)); };
  if (grid_->nearest) return read(3 * nearest(*grid_, voxel));
  return interpolate<Color>(*grid_, voxel, read);
}

}  // namespace waylight
