#pragma once

#include "tools/common/chart_data.h"
#include "tools/common/cli.h"

namespace waylight {

// Draws the chart into options.output and, when asked, a PNG of the same name.
void chart(const ToolRun& run, const ChartOptions& options);

}  // namespace waylight
