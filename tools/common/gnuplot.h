#pragma once
// Gnuplot as the drawing engine of charts.

#include <string>
#include <vector>

#include "tools/common/chart_data.h"

namespace waylight {

enum class ChartFormat { svg, small_svg, png };  // small: several side by side

// The commands that draw the lines into the file `output`. The same text for equal input.
std::string gnuplot_script(const ChartOptions& options, const std::vector<ChartLine>& lines,
                           ChartFormat format, const std::string& output);

// Pipes the commands to gnuplot. Throws Error with the remedy when it is missing or fails.
void run_gnuplot(const std::string& script);

// Labelled positions on a logarithmic axis from low to high: powers of ten, with 2 and 5 of each
// decade where there are at most two and a half, and more in a part of one.
std::vector<double> logarithmic_ticks(double low, double high);

}  // namespace waylight
