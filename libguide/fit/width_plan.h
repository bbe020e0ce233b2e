#pragma once
// At which widths a material of textured width is fitted.

#include <vector>

#include "libguide/base/run_control.h"
#include "libguide/bsdf/textured_width.h"
#include "libguide/fit/lobe_fit.h"

namespace waylight {

struct WidthPlan {
  std::vector<float> widths;  // ascending
  double seconds = 0;         // of one core, for the fits and tests that it took
};

// As many, evenly spaced on a logarithmic scale, as keep the error between them within `tolerance`
// at three elevations (FitRefinement); at most 64.
WidthPlan plan_widths(std::span<const Material> materials, int material, const WidthRange& range,
                      float tolerance, const LobeFitOptions& options, const RunControl& control);

}  // namespace waylight
