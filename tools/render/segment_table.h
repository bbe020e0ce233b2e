#pragma once

#include <string>

#include "libguide/transport/segment_sums.h"

namespace waylight {

// One row per number of edges, up to the last that a path reached:
//   scene, method,
//   edges         the last row that a table can have, 64, stands for all longer paths
//   reach         edges traced at this place per camera path; above 1 where paths were split
//   contribution  share of the image's luminance; 0 everywhere in a black image
//   cumulative    sum of the contributions up to here
// The file appears complete or not at all.
void write_segment_table(const std::string& path, const std::string& scene,
                         const std::string& method, const SegmentSums& sums);

}  // namespace waylight
