#pragma once
// The voxels of a grid in bricks, of which those of one value are stored once for all.

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "libguide/math/types.h"

namespace waylight {

// Voxels from `first` to `last`, both included.
struct VoxelBox {
  Eigen::Vector3i first, last;

  Eigen::Vector3i extent() const { return last - first + Eigen::Vector3i::Ones(); }
  int64_t count() const { return extent().cast<int64_t>().prod(); }
};

// Where voxels come from. Values of more channels are interleaved, as everywhere.
class VoxelSource {
 public:
  virtual ~VoxelSource() = default;

  // Whether all voxels of a box, at most 129 along its sides, have one value, as far as that can be
  // told without a look at each; if so, `value` is set.
  virtual bool constant(const VoxelBox& box, float* value) const = 0;
  // All values of a box of at most 9^3 voxels, x fastest.
  virtual void read(const VoxelBox& box, float* values) const = 0;
};

// A table of nodes of 16^3 bricks of 8^3 voxels. A brick has its neighbours' first layer below each
// of its axes too, 9^3 in all, so that the eight voxels about any point are in one brick: 1.42
// times the memory of what is stored, for one look-up instead of up to eight. There the outermost
// voxels of the grid are repeated once beyond it. Bricks of one value, and nodes of such bricks,
// are stored once for each value.
class VoxelBricks {
 public:
  static constexpr int kBrickShift = 3, kNodeShift = 7;  // log2 of the sides, in voxels
  static constexpr int kRow = 9, kSlice = kRow * kRow;   // from a voxel to the next along y and z
  static constexpr int kBrickVoxels = kRow * kSlice;

  VoxelBricks() = default;
  VoxelBricks(const Eigen::Vector3i& size, int channels, const VoxelSource& source);
  // Voxel (x, y, z) is at (z * size.y + y) * size.x + x of the dense array.
  VoxelBricks(const Eigen::Vector3i& size, int channels, std::span<const float> dense);

  bool operator==(const VoxelBricks&) const = default;

  const Eigen::Vector3i& size() const { return size_; }
  int channels() const { return channels_; }
  size_t stored_bricks() const { return constant_bricks_.size(); }

  // The value of a voxel; those of the next ones along x, y and z are at `channels` times 1, kRow
  // and kSlice. Along each axis from -1, which is voxel 0 again, to size - 1.
  const float* at(const Eigen::Vector3i& voxel) const {
    return &values_[offset(brick_at(voxel), voxel)];
  }

  // Calls visit(value, count) for the voxels of a box within the grid, at once for all that the box
  // has in common with a brick or a node of one value.
  template <typename Visit>
  void visit(const VoxelBox& box, const Visit& visit) const;

  // The least and the greatest value of any voxel and channel.
  struct Range {
    float least, most;
  };
  Range range() const;
  void scale(float factor);

  // All that tells two grids apart.
  auto parts() const { return std::tie(size_, channels_, table_, nodes_, values_); }

 private:
  friend class BrickBuilder;
  static constexpr int kNodeBricks = 16 * 16 * 16;

  // Voxel i is the voxel i + 1 of the bricks.
  uint32_t node_at(const Eigen::Vector3i& voxel) const {
    const auto along = [&](int axis) {
      return static_cast<uint32_t>(voxel[axis] + 1) >> kNodeShift;
    };
    return table_[(size_t{along(2)} * counts_.y() + along(1)) * counts_.x() + along(0)];
  }
  uint32_t brick_at(const Eigen::Vector3i& voxel) const {
    const auto along = [&](int axis) {
      return (static_cast<uint32_t>(voxel[axis] + 1) >> kBrickShift) % 16;
    };
    return nodes_[size_t{node_at(voxel)} * kNodeBricks + (along(2) * 16 + along(1)) * 16 +
                  along(0)];
  }
  size_t offset(uint32_t brick, const Eigen::Vector3i& voxel) const {
    const auto along = [&](int axis) { return static_cast<uint32_t>(voxel[axis] + 1) % 8; };
    return (size_t{brick} * kBrickVoxels + along(2) * kSlice + along(1) * kRow + along(0)) *
           channels_;
  }

  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  int channels_ = 1;
  Eigen::Vector3i counts_ = Eigen::Vector3i::Zero();  // of nodes
  std::vector<uint32_t> table_;                       // of nodes
  std::vector<uint32_t> nodes_;                       // bricks of each
  std::vector<float> values_;                         // of each brick
  std::vector<bool> constant_nodes_, constant_bricks_;
};

// Calls visit(part) for the parts of a box that lie in one cell each, of bricks or of nodes.
template <typename Visit>
void split_box(const VoxelBox& box, int shift, const Visit& visit) {
  const auto next = [&](int i) { return ((((i + 1) >> shift) + 1) << shift) - 1; };
  const auto& [first, last] = box;
  for (int z = first.z(); z <= last.z(); z = next(z))
    for (int y = first.y(); y <= last.y(); y = next(y))
      for (int x = first.x(); x <= last.x(); x = next(x)) {
        const Eigen::Vector3i end(next(x) - 1, next(y) - 1, next(z) - 1);
        visit(VoxelBox{{x, y, z}, end.cwiseMin(last)});
      }
}

template <typename Visit>
void for_each_voxel(const VoxelBox& box, const Visit& visit) {
  for (int z = box.first.z(); z <= box.last.z(); ++z)
    for (int y = box.first.y(); y <= box.last.y(); ++y)
      for (int x = box.first.x(); x <= box.last.x(); ++x) visit(Eigen::Vector3i(x, y, z));
}

template <typename Visit>
void VoxelBricks::visit(const VoxelBox& box, const Visit& visit) const {
  split_box(box, kNodeShift, [&](const VoxelBox& in_node) {
    if (constant_nodes_[node_at(in_node.first)]) return visit(at(in_node.first), in_node.count());
    split_box(in_node, kBrickShift, [&](const VoxelBox& part) {
      const uint32_t brick = brick_at(part.first);
      if (constant_bricks_[brick]) return visit(at(part.first), part.count());
      for_each_voxel(part, [&](const Eigen::Vector3i& voxel) {
        visit(&values_[offset(brick, voxel)], int64_t{1});
      });
    });
  });
}

}  // namespace waylight
