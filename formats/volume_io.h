#pragma once
// Volume grids in and out. Values of more channels are interleaved. The centre of voxel i
// of n is at (i + 0.5) / n of the grid's [0,1]^3. Values that are not finite are an Error; negative
// ones, noise of simulations, become 0.

#include <map>
#include <string>

#include "libguide/medium/medium.h"

namespace waylight {

// Mitsuba .vol version 3: 1 or 3 channels, float32 or uint8 (255 is 1); grid_to_world maps [0,1]^3
// to the file's box.
VolumeGrid read_vol(const std::string& path);
// OpenVDB float, half or double grid (or vectors of three), cropped to its active box, leaf by
// leaf: what is empty takes neither memory nor time; grid_to_world from its transform. An empty
// gridname takes the only grid, or "density". A grid without active voxels becomes one voxel of the
// background value.
VolumeGrid read_vdb(const std::string& path, const std::string& gridname);

// OpenVDB float grid of one channel. Sparse: what is 0 is background, and not stored. Equal grids
// give equal bytes.
void write_vdb(const std::string& path, const VolumeGrid& grid, const std::string& gridname,
               const std::map<std::string, std::string>& metadata = {});

}  // namespace waylight
