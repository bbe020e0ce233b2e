#pragma once
// A procedural cumulus cloud: puffs that bud from puffs, their hull made billowy by cell noise.

#include <cstdint>

#include "libguide/medium/medium.h"

namespace waylight {

struct CloudOptions {
  int resolution = 128;   // voxels along x, the longest side, 16 to 1024
  int puffs = 7;          // of the first generation, 1 to 64
  float coverage = 0.7f;  // 0: a wisp, 1: fills its box
  float billows = 0.5f;   // depth of the creases, 0 to 1
  float edge = 0.06f;     // width of the rim in which density rises from 0 to 1
  uint64_t seed = 0;

  void validate() const;  // throws Misuse
};

// Density in [0, 1], 0 in the outermost voxels, in the box [-1, 1] x [-0.6, 0.6] x [-0.75, 0.75]
// of the world. About 0.8 within and 0 outside: most of the box is empty.
VolumeGrid make_cloud(const CloudOptions& options);

}  // namespace waylight
