#pragma once
// What every volume grid passes, whatever format it came from.

#include <string>

#include "libguide/medium/medium.h"

namespace waylight {

// Throws Error unless each size is positive and there are at most 2^30 voxels.
void check_volume_size(const std::string& path, int64_t x, int64_t y, int64_t z);

// Throws Error at the first value that is not finite; negative ones become 0.
void finish_volume(VolumeGrid& grid, const std::string& path);

}  // namespace waylight
