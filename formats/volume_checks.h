#pragma once
// What every volume grid passes, whatever format it came from.

#include <string>

#include "libguide/medium/voxel_bricks.h"

namespace waylight {

// Throws Error unless the grid has voxels, at most 2^22 along an axis, where single precision still
// resolves a quarter of one, and spans at most 2^24 nodes of 128^3.
void check_volume_size(const std::string& path, int64_t x, int64_t y, int64_t z);

// The voxels of the file `path`. Throws Error at the first value that is not finite, and where more
// than 2^22 bricks hold other than one value; negative values become 0.
VoxelBricks checked_bricks(const std::string& path, const Eigen::Vector3i& size, int channels,
                           const VoxelSource& voxels);

}  // namespace waylight
