#pragma once

#include "libguide/math/types.h"

namespace waylight {

// One weighted von Mises-Fisher lobe over the sphere, as caches store it. Its density is
//   kappa / (2 pi (1 - e^(-2 kappa))) e^(kappa (mean . w - 1)) per steradian,
// 1 / (4 pi) for kappa = 0.
struct VmfComponent {
  float weight = 0;
  Vec3 mean = Vec3::UnitZ();  // unit
  float kappa = 0;            // concentration, not negative
};
static_assert(sizeof(VmfComponent) == 20);

// The decayed sufficient statistics of one lobe: s0 its share of the weight (they sum to 1 over a
// mixture), s1 = s0 times the mean of its directions, whose length is s0 times the mean resultant
// length.
struct VmfStatistics {
  float s0 = 0;
  Vec3 s1 = Vec3::Zero();
};
static_assert(sizeof(VmfStatistics) == 16);

}  // namespace waylight
