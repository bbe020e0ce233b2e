#include "libguide/medium/extinction_blocks.h"

namespace waylight {
namespace {

constexpr int64_t kMaxBlocks = int64_t{1} << 21;  // 25 MB

Eigen::Vector3i counts_of(const Eigen::Vector3i& size, int side) {
  return ((size.array() + (side - 1)) / side).matrix();
}

// Voxels along the side of a block: small grids keep about sixteen blocks along their longest axis,
// and blocks grow where a wide grid would have too many of them.
int side_of(const Eigen::Vector3i& size) {
  int side = std::clamp(size.maxCoeff() / 16, 1, 8);
  while (counts_of(size, side).cast<int64_t>().prod() > kMaxBlocks) side *= 2;
  return side;
}

}  // namespace

ExtinctionBlocks::ExtinctionBlocks(const VolumeGrid& density, float scale)
    : side_(side_of(density.size())), to_voxels_(density) {
  counts_ = counts_of(density.size(), side_);
  low_ = density.margin() / static_cast<float>(side_);
  high_ = density.size().cast<float>() / static_cast<float>(side_) - low_;
  blocks_.reserve(static_cast<size_t>(counts_.x()) * counts_.y() * counts_.z());
  for (int z = 0; z < counts_.z(); ++z)
    for (int y = 0; y < counts_.y(); ++y)
      for (int x = 0; x < counts_.x(); ++x) {
        blocks_.push_back(bounds_of(density, scale, {x, y, z}));
      }
}

ExtinctionBounds ExtinctionBlocks::bounds_of(const VolumeGrid& density, float scale,
                                             const Eigen::Vector3i& block) const {
  const Eigen::Vector3i ones = Eigen::Vector3i::Ones();
  const VoxelBox voxels{(block * side_ - ones).cwiseMax(0),
                        ((block + ones) * side_).cwiseMin(density.size() - ones)};
  ExtinctionBounds bounds{kInfinity, 0, 0};
  double sum = 0;
  density.voxels.visit(voxels, [&](const float* values, int64_t count) {
    for (int c = 0; c < density.voxels.channels(); ++c) {
      const float value = scale * values[c];
      bounds.least = std::min(bounds.least, value);
      bounds.most = std::max(bounds.most, value);
      sum += static_cast<double>(count) * value;
    }
  });
  const auto count = static_cast<double>(voxels.count() * density.voxels.channels());
  bounds.mean = static_cast<float>(sum / count);
  return bounds;
}

BlockWalk::BlockWalk(const ExtinctionBlocks& blocks, const Ray& ray, float t_max)
    : blocks_(&blocks), t_(0), t_exit_(t_max) {
  const float side = static_cast<float>(blocks.side_);
  const Vec3 origin = blocks.to_voxels_.point(ray.origin) / side;
  const Vec3 direction = blocks.to_voxels_.direction(ray.direction) / side;
  for (int axis = 0; axis < 3; ++axis) {
    const float o = origin[axis], d = direction[axis];
    const float low = blocks.low_[axis], high = blocks.high_[axis];
    if (d == 0) {
      if (o < low || o > high) t_exit_ = -1;
      continue;
    }
    const float to_low = (low - o) / d, to_high = (high - o) / d;
    t_ = std::max(t_, std::min(to_low, to_high));
    t_exit_ = std::min(t_exit_, std::max(to_low, to_high));
  }
  if (!(t_ < t_exit_)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const float o = origin[axis], d = direction[axis];
    block_[axis] = std::clamp(static_cast<int>(o + t_ * d), 0, blocks.counts_[axis] - 1);
    step_[axis] = d < 0 ? -1 : 1;
    t_step_[axis] = d == 0 ? kInfinity : 1 / std::abs(d);
    t_next_[axis] = d == 0 ? kInfinity : (static_cast<float>(block_[axis] + (d > 0)) - o) / d;
  }
}

BlockWalk::BlockWalk(const ExtinctionBounds& bounds, float t_max)
    : single_(bounds), t_(0), t_exit_(bounds.most > 0 ? t_max : 0) {}

bool BlockWalk::next(RayBlock& block) {
  if (!blocks_) {
    static_cast<ExtinctionBounds&>(block) = single_;
    block.t0 = t_, block.t1 = t_exit_;
    t_ = t_exit_;
    return block.t0 < block.t1;
  }
  while (t_ < t_exit_) {
    int axis;
    t_next_.minCoeff(&axis);
    static_cast<ExtinctionBounds&>(block) = blocks_->at(block_);
    block.t0 = t_;
    block.t1 = std::clamp(t_next_[axis], t_, t_exit_);
    t_ = block.t1;
    block_[axis] += step_[axis];
    t_next_[axis] += t_step_[axis];
    if (block_[axis] < 0 || block_[axis] >= blocks_->counts_[axis]) t_ = t_exit_;
    if (block.most > 0 && block.t1 > block.t0) return true;
  }
  return false;
}

}  // namespace waylight
