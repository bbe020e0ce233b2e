#pragma once

#include <optional>

#include "libguide/records/guide_cache.h"

namespace waylight {

struct CellSplit {
  uint32_t axis = 0;  // as in CacheNode
  float value = 0;

  bool by_normal() const { return axis >= kNormalAxis; }
};

// Where to split a cell that has seen enough photons, at their mean: the normal coordinate of
// largest variance when the mean normal is shorter than `normal_spread`, else the position
// coordinate of largest variance. Empty when all photons are in one place: `min_extent` is the
// least standard deviation, in units of length, at which splitting still separates anything.
std::optional<CellSplit> choose_split(const CellTraining& cell, float normal_spread,
                                      float min_extent);

// The position coordinate of largest variance alone.
std::optional<CellSplit> choose_position_split(const Vec3& mean, const Vec3& variance,
                                               float min_extent);

}  // namespace waylight
