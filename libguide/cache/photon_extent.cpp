#include "libguide/cache/photon_extent.h"

#include <algorithm>

namespace waylight {
namespace {

constexpr int kStrays = 2;  // groups whose ends are left out, on each side

}  // namespace

Bounds PhotonExtent::box() const {
  if (count_ < kGroups) return {};
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<float, kGroups> low, high;
    for (uint32_t i = 0; i < kGroups; ++i)
      low[i] = groups_[i].min[axis], high[i] = -groups_[i].max[axis];
    for (auto* ends : {&low, &high})
      std::nth_element(ends->begin(), ends->begin() + kStrays, ends->end());
    box.min[axis] = low[kStrays];
    box.max[axis] = -high[kStrays];
  }
  return box;
}

}  // namespace waylight
