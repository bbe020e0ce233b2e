#pragma once
// The rows of image-compare's tables as runs: scene, method, seed, and checkpoints over time.

#include <string>
#include <vector>

#include "libguide/base/run_control.h"
#include "tools/common/chart_data.h"

namespace waylight {

struct Checkpoint {
  std::string scene, method, seed;
  double seconds = 0, preprocess_seconds = 0, spp = 0;  // preprocess_seconds 0: there is none
  double relmse = 0, relmse_trimmed = 0;
  double sample_ms = 0, path_length = 0, memory_bytes = 0;  // 0: not known
  std::string image, reference;                             // found beside the table or as it says
  std::vector<std::string> preprocess_stats;                // files that are there

  double total_seconds() const { return seconds + preprocess_seconds; }
};

using Field = double (*)(const Checkpoint&);

struct Method {
  std::string name;
  // Each of rising time; checkpoints of one index are of one time.
  std::vector<std::vector<Checkpoint>> seeds;

  const Checkpoint& last() const { return seeds[0].back(); }
};

struct SceneRuns {
  std::string name;
  std::vector<Method> methods;  // the first is the one that others are compared with
};

// Scenes and methods in the order in which they appear; `base`, if not empty, comes first in each.
// Of the checkpoints those stay that all seeds of a method have, with a warning where that is not
// all; rows whose error is not above 0 are left out with a warning. Throws Error naming file and
// row for what is missing, and for two rows of one seed and time that differ.
std::vector<SceneRuns> read_runs(const std::vector<std::string>& tables, const std::string& base,
                                 const RunControl& control);

// Means over seeds, and the range of y, at each checkpoint.
ChartLine line_of(const Method& method, Field x, Field y);
// The same of the last checkpoint.
ChartPoint final_mean(const Method& method, Field y);

}  // namespace waylight
