#pragma once
// Values of a volume grid at points of the world.

#include <memory>

#include "libguide/medium/medium.h"

namespace waylight {

// The map from the world to the voxels of a grid, in which voxel i spans [i, i + 1]; affine, so
// distances along a ray are the same in both.
class WorldToVoxels {
 public:
  WorldToVoxels() = default;
  explicit WorldToVoxels(const VolumeGrid& grid) {
    const Mat4 inverse = grid.grid_to_world.cast<double>().inverse().cast<float>();
    const Vec3 margin = grid.margin(), size = grid.size().cast<float>() - 2 * margin;
    linear_ = size.asDiagonal() * inverse.topLeftCorner<3, 3>();
    offset_ = margin + size.cwiseProduct(inverse.topRightCorner<3, 1>());
  }
  Vec3 point(const Vec3& p) const { return linear_ * p + offset_; }
  Vec3 direction(const Vec3& d) const { return linear_ * d; }

 private:
  Mat3 linear_ = Mat3::Identity();
  Vec3 offset_ = Vec3::Zero();
};

// Trilinear between the centres of voxels, or the value of the voxel; constant over the outer half
// voxel, unless the outermost values stand on the sides. Outside of the grid 0.
class GridLookup {
 public:
  explicit GridLookup(std::shared_ptr<const VolumeGrid> grid)
      : grid_(std::move(grid)),
        to_voxels_(*grid_),
        low_(grid_->margin()),
        high_(grid_->size().cast<float>() - low_) {}

  const VolumeGrid& grid() const { return *grid_; }
  bool scalar() const { return grid_->voxels.channels() == 1; }
  float at(const Vec3& world) const;        // of a grid of one channel
  Color color_at(const Vec3& world) const;  // grey of one channel

 private:
  bool holds(const Vec3& voxel) const {
    return (voxel.array() >= low_.array()).all() && (voxel.array() <= high_.array()).all();
  }

  std::shared_ptr<const VolumeGrid> grid_;
  WorldToVoxels to_voxels_;
  Vec3 low_, high_;  // the sides of the grid, in voxels
};

}  // namespace waylight
