#include "libguide/medium/extinction_blocks.h"

namespace waylight {
namespace {

// Voxels along the side of a block: small grids keep about sixteen blocks along their longest axis.
int side_of(const Eigen::Vector3i& size) { return std::clamp(size.maxCoeff() / 16, 1, 8); }

}  // namespace

ExtinctionBlocks::ExtinctionBlocks(const VolumeGrid& density, float scale)
    : side_(side_of(density.size)), to_voxels_(density) {
  counts_ = ((density.size.array() + side_ - 1) / side_).matrix();
  extent_ = density.size.cast<float>() / static_cast<float>(side_);
  blocks_.reserve(static_cast<size_t>(counts_.x()) * counts_.y() * counts_.z());
  for (int z = 0; z < counts_.z(); ++z)
    for (int y = 0; y < counts_.y(); ++y)
      for (int x = 0; x < counts_.x(); ++x) {
        blocks_.push_back(bounds_of(density, scale, {x, y, z}));
        most_ = std::max(most_, blocks_.back().most);
      }
}

ExtinctionBounds ExtinctionBlocks::bounds_of(const VolumeGrid& density, float scale,
                                             const Eigen::Vector3i& block) const {
  const Eigen::Vector3i ones = Eigen::Vector3i::Ones();
  const Eigen::Vector3i first = (block * side_ - ones).cwiseMax(0);
  const Eigen::Vector3i last = ((block + ones) * side_).cwiseMin(density.size - ones);
  ExtinctionBounds bounds{kInfinity, 0, 0};
  double sum = 0;
  size_t count = 0;
  for (int z = first.z(); z <= last.z(); ++z)
    for (int y = first.y(); y <= last.y(); ++y) {
      const size_t row = (size_t(z) * density.size.y() + y) * density.size.x();
      const size_t c = density.channels;
      for (size_t i = (row + first.x()) * c; i < (row + last.x() + 1) * c; ++i, ++count) {
        const float value = scale * density.values[i];
        bounds.least = std::min(bounds.least, value);
        bounds.most = std::max(bounds.most, value);
        sum += value;
      }
    }
  bounds.mean = static_cast<float>(sum / static_cast<double>(count));
  return bounds;
}

BlockWalk::BlockWalk(const ExtinctionBlocks& blocks, const Ray& ray, float t_max)
    : blocks_(&blocks), t_(0), t_exit_(t_max) {
  const float side = static_cast<float>(blocks.side_);
  const Vec3 origin = blocks.to_voxels_.point(ray.origin) / side;
  const Vec3 direction = blocks.to_voxels_.direction(ray.direction) / side;
  for (int axis = 0; axis < 3; ++axis) {
    const float o = origin[axis], d = direction[axis];
    const float size = blocks.extent_[axis];
    if (d == 0) {
      if (o < 0 || o > size) t_exit_ = -1;
      continue;
    }
    const float to_low = -o / d, to_high = (size - o) / d;
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
