#pragma once
// Charts and tables of a scene, as HTML.

#include "tools/report/reach.h"

namespace waylight {

// Three digits, or a dash for 0, which is not known.
std::string text_of(double value);
std::string bytes_of(double value);

// "12.3 (11.9 to 12.8)", the range where there is one.
std::string with_range(const ChartPoint& point);

// Times faster, each scene a row; scenes with other methods begin another table.
std::string summary_tables(const std::vector<SceneRuns>& scenes);

std::string final_table(const SceneRuns& scene);  // figures at the end, and at equal samples
std::string reach_table_html(const SceneRuns& scene);

// Charts of error over time and samples, and bars of what a sample costs. Gnuplot's files are made
// beside `output` and removed.
std::string scene_charts(const SceneRuns& scene, const std::string& output);

// The picture of an SVG file, to stand in a page.
std::string inline_svg(const std::string& svg);

}  // namespace waylight
