#include "libguide/cache/cell_split.h"

namespace waylight {
namespace {

// Normals closer together than this (standard deviation, about half a degree) are the same.
constexpr float kMinNormalDeviation = 0.01f;

std::optional<CellSplit> split_widest(const Vec3& mean, const Vec3& variance, float min_deviation,
                                      uint32_t first_axis) {
  Eigen::Index axis = 0;
  if (!(variance.maxCoeff(&axis) > sqr(min_deviation))) return std::nullopt;
  return CellSplit{first_axis + static_cast<uint32_t>(axis), mean[axis]};
}

}  // namespace

std::optional<CellSplit> choose_split(const CellTraining& cell, float normal_spread,
                                      float min_extent) {
  if (cell.count < 2) return std::nullopt;
  if (cell.normal_mean.norm() < normal_spread) {
    const auto split = split_widest(cell.normal_mean, cell.normal_m2 / cell.count,
                                    kMinNormalDeviation, kNormalAxis);
    if (split) return split;
  }
  return choose_position_split(cell.position_mean, cell.position_m2 / cell.count, min_extent);
}

std::optional<CellSplit> choose_position_split(const Vec3& mean, const Vec3& variance,
                                               float min_extent) {
  return split_widest(mean, variance, min_extent, 0);
}

}  // namespace waylight
