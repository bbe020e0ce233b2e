#include "libguide/medium/voxel_bricks.h"

#include <array>
#include <map>

namespace waylight {
namespace {

// An array of all voxels.
class DenseVoxels : public VoxelSource {
 public:
  DenseVoxels(const Eigen::Vector3i& size, int channels, std::span<const float> values)
      : size_(size), channels_(channels), values_(values) {}

  bool constant(const VoxelBox& /*box*/, float* /*value*/) const override { return false; }
  void read(const VoxelBox& box, float* values) const override {
    for (int z = box.first.z(); z <= box.last.z(); ++z)
      for (int y = box.first.y(); y <= box.last.y(); ++y) {
        const size_t row = (size_t(z) * size_.y() + y) * size_.x() + box.first.x();
        const size_t count = size_t(box.extent().x()) * channels_;
        values = std::copy_n(&values_[row * channels_], count, values);
      }
  }

 private:
  Eigen::Vector3i size_;
  int channels_;
  std::span<const float> values_;
};

}  // namespace

class BrickBuilder {
 public:
  BrickBuilder(VoxelBricks& grid, const VoxelSource& source) : grid_(grid), source_(source) {}

  void build() {
    const Eigen::Vector3i last = (grid_.counts_.array() - 1).matrix();
    for_each_voxel({Eigen::Vector3i::Zero(), last},
                   [&](const Eigen::Vector3i& node) { grid_.table_.push_back(add_node(node)); });
  }

 private:
  using Value = std::array<float, 3>;
  using Node = std::array<uint32_t, VoxelBricks::kNodeBricks>;

  // Of a brick or a node, whose voxel 0 repeats that of the one before.
  VoxelBox voxels_of(const Eigen::Vector3i& cell, int shift) const {
    const int side = 1 << shift;
    const VoxelBox box{(cell.array() * side - 1).matrix(),
                       (cell.array() * side + side - 1).matrix()};
    return {within(box.first), within(box.last)};
  }
  Eigen::Vector3i within(const Eigen::Vector3i& voxel) const {
    return voxel.cwiseMax(0).cwiseMin((grid_.size_.array() - 1).matrix());
  }

  uint32_t add_node(const Eigen::Vector3i& node) {
    Value value{};
    if (source_.constant(voxels_of(node, VoxelBricks::kNodeShift), value.data()))
      return constant_node(constant_brick(value));
    Node bricks;
    uint32_t* next = bricks.data();
    for_each_voxel({16 * node, (16 * node.array() + 15).matrix()},
                   [&](const Eigen::Vector3i& brick) {
                     const bool beyond = ((8 * brick).array() > grid_.size_.array()).any();
                     *next++ = beyond ? bricks[0] : add_brick(brick);
                   });
    const bool constant = grid_.constant_bricks_[bricks[0]] &&
                          std::all_of(bricks.begin(), bricks.end(),
                                      [&](uint32_t brick) { return brick == bricks[0]; });
    return constant ? constant_node(bricks[0]) : store(bricks, false);
  }

  uint32_t add_brick(const Eigen::Vector3i& brick) {
    const VoxelBox box = voxels_of(brick, VoxelBricks::kBrickShift);
    Value value{};
    if (source_.constant(box, value.data())) return constant_brick(value);
    const size_t count = box.count() * grid_.channels_;
    read_.resize(count);
    source_.read(box, read_.data());
    std::copy_n(read_.begin(), grid_.channels_, value.begin());
    const auto begins_again =
        std::equal(read_.begin() + grid_.channels_, read_.end(), read_.begin());
    return begins_again ? constant_brick(value) : store_read(brick, box);
  }

  // What was read of a box, the border repeated beyond the grid.
  uint32_t store_read(const Eigen::Vector3i& brick, const VoxelBox& box) {
    if (box.count() == VoxelBricks::kBrickVoxels) {
      grid_.values_.insert(grid_.values_.end(), read_.begin(), read_.end());
      return count_brick(false);
    }
    const Eigen::Vector3i first = (8 * brick.array() - 1).matrix(), extent = box.extent();
    for_each_voxel({first, (first.array() + 8).matrix()}, [&](const Eigen::Vector3i& voxel) {
      const Eigen::Vector3i i = within(voxel) - box.first;
      const size_t at = (size_t(i.z()) * extent.y() + i.y()) * extent.x() + i.x();
      for (int c = 0; c < grid_.channels_; ++c)
        grid_.values_.push_back(read_[at * grid_.channels_ + c]);
    });
    return count_brick(false);
  }

  uint32_t constant_brick(const Value& value) {
    const auto [known, is_new] = constant_bricks_.try_emplace(value, 0);
    if (!is_new) return known->second;
    for (int i = 0; i < VoxelBricks::kBrickVoxels; ++i)
      grid_.values_.insert(grid_.values_.end(), value.begin(), value.begin() + grid_.channels_);
    return known->second = count_brick(true);
  }
  uint32_t count_brick(bool constant) {
    grid_.constant_bricks_.push_back(constant);
    return static_cast<uint32_t>(grid_.constant_bricks_.size() - 1);
  }

  uint32_t constant_node(uint32_t brick) {
    const auto [known, is_new] = constant_nodes_.try_emplace(brick, 0);
    if (!is_new) return known->second;
    Node bricks;
    bricks.fill(brick);
    return known->second = store(bricks, true);
  }
  uint32_t store(const Node& bricks, bool constant) {
    grid_.nodes_.insert(grid_.nodes_.end(), bricks.begin(), bricks.end());
    grid_.constant_nodes_.push_back(constant);
    return static_cast<uint32_t>(grid_.constant_nodes_.size() - 1);
  }

  VoxelBricks& grid_;
  const VoxelSource& source_;
  std::map<Value, uint32_t> constant_bricks_;
  std::map<uint32_t, uint32_t> constant_nodes_;  // by their brick
  std::vector<float> read_;
};

VoxelBricks::VoxelBricks(const Eigen::Vector3i& size, int channels, const VoxelSource& source)
    : size_(size), channels_(channels) {
  for (int axis = 0; axis < 3; ++axis) counts_[axis] = (size[axis] >> kNodeShift) + 1;
  BrickBuilder(*this, source).build();
}

VoxelBricks::VoxelBricks(const Eigen::Vector3i& size, int channels, std::span<const float> dense)
    : VoxelBricks(size, channels, DenseVoxels(size, channels, dense)) {}

VoxelBricks::Range VoxelBricks::range() const {
  const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
  return {*least, *most};
}

void VoxelBricks::scale(float factor) {
  for (float& value : values_) value *= factor;
}

}  // namespace waylight
