#pragma once
// Bounds of a grid's extinction over blocks of voxels, and the walk of a ray through them.

#include <vector>

#include "libguide/medium/grid_lookup.h"

namespace waylight {

// Of the extinction in all channels, per unit length.
struct ExtinctionBounds {
  float least = 0, mean = 0, most = 0;
};

// A stretch of a ray and what holds along it.
struct RayBlock : ExtinctionBounds {
  float t0 = 0, t1 = 0;

  float length() const { return t1 - t0; }
};

// Bounds hold for every point of a block under trilinear interpolation: they take in the voxels
// next to it. One majorant for a whole cloud would cost a lookup for every mean free path of its
// densest voxel.
class ExtinctionBlocks {
 public:
  ExtinctionBlocks() = default;
  ExtinctionBlocks(const VolumeGrid& density, float scale);

  int side() const { return side_; }  // voxels
  const Eigen::Vector3i& counts() const { return counts_; }
  const ExtinctionBounds& at(const Eigen::Vector3i& block) const {
    return blocks_[(size_t(block.z()) * counts_.y() + block.y()) * counts_.x() + block.x()];
  }

 private:
  friend class BlockWalk;
  ExtinctionBounds bounds_of(const VolumeGrid& density, float scale,
                             const Eigen::Vector3i& block) const;

  int side_ = 1;
  Eigen::Vector3i counts_ = Eigen::Vector3i::Zero();
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();  // sides of the grid, in blocks; these may go on
  WorldToVoxels to_voxels_;
  std::vector<ExtinctionBounds> blocks_;
};

// The blocks that a ray meets up to a distance, in order; those without extinction are left out
// [Amanatides, Woo 1987].
class BlockWalk {
 public:
  BlockWalk(const ExtinctionBlocks& blocks, const Ray& ray, float t_max);
  // A single block, of a homogeneous medium.
  BlockWalk(const ExtinctionBounds& bounds, float t_max);

  bool next(RayBlock& block);

 private:
  const ExtinctionBlocks* blocks_ = nullptr;
  ExtinctionBounds single_;
  float t_, t_exit_;
  Eigen::Vector3i block_ = Eigen::Vector3i::Zero(), step_ = Eigen::Vector3i::Zero();
  Vec3 t_next_ = Vec3::Zero(),
       t_step_ = Vec3::Zero();  // distance to the next block along each axis
};

}  // namespace waylight
