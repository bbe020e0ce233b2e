#pragma once
// How soon each method has the error that the first one has at its end.

#include "tools/report/runs.h"

namespace waylight {

struct Reach {
  std::string scene, method;
  double target = 0;              // relMSE of the first method at its end, mean of seeds
  double seconds = 0;             // of rendering
  double low = 0, high = 0;       // over seeds
  double preprocess_seconds = 0;  // in addition
  double ratio = 0;               // time of the first method over `seconds`
  double total_ratio = 0;         // the same with preprocessing on both sides
  double trimmed_ratio = 0;       // as `ratio`, by errors without the worst 0.1 % of the pixels
  bool extrapolated = false;      // beyond the checkpoints, along slope -1
};

std::vector<Reach> reach_table(const SceneRuns& scene);

// y where the line, straight between points on logarithmic axes, last crosses x, so that a line
// that meets x and leaves it again is not there yet; beyond its nearer end along slope -1. The
// points need not rise in x.
double cross(const std::vector<ChartPoint>& line, double x, bool* beyond = nullptr);

}  // namespace waylight
