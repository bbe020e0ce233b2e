#pragma once
// Lobes of a cell of a medium as pictures of the whole sphere, on the equal-area disk about +z.

#include <string>

#include "libguide/math/types.h"
#include "tools/cache-info/lobe_plot.h"

namespace waylight {

// The indirect and the direct light of the cell at a position, the photons of each beside it, and
// both together beside the truth.
void plot_medium(const ToolRun& run, const std::string& cache, const Vec3& position,
                 const LobePlotArguments& arguments);

}  // namespace waylight
