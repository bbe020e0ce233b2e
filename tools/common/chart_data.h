#pragma once
// The lines of a chart, from tables that image-compare writes.

#include <string>
#include <vector>

#include "libguide/base/run_control.h"

namespace waylight {

struct ChartOptions {
  std::vector<std::string> tables;  // CSV files
  std::string output;               // SVG
  std::string title;
  std::string x = "seconds", y = "relmse";  // columns of numbers
  std::string lines = "method";             // column that tells the lines apart
  std::string linear;                       // axes that are not logarithmic: "", "x", "y" or "xy"
  std::string labels;                       // column of words beside the points, or none
  std::string standard;                     // the label of the default value, or none
  bool bars = false;                        // one bar per line: y at its largest x
  bool preprocess = false;                  // add preprocess_seconds to x
  bool png = false;                         // write a PNG beside the SVG too

  void validate() const;
  bool is_linear(char axis) const {
    return (bars && axis == 'y') || linear.find(axis) != std::string::npos;
  }
  bool has_squared_error() const { return y == "mse" || y == "relmse" || y == "relmse_trimmed"; }
  // Whether an unbiased method's error falls with slope -1 in this chart: squared errors do, with
  // the time of rendering alone.
  bool has_slope() const {
    return !bars && !preprocess && linear.empty() && standard.empty() && has_squared_error() &&
           (x == "seconds" || x == "cpu_seconds" || x == "spp");
  }
  // Whether error times time tells which values are better than the default.
  bool has_product() const {
    return !standard.empty() && has_squared_error() && (x == "seconds" || x == "cpu_seconds");
  }
};

// The options, with the columns `edges` and `contribution` on linear axes where the first table is
// one of `render --segments` and neither --x nor --y says otherwise.
ChartOptions with_columns_of_table(const ChartOptions& options);

// Rows that share line and x: the means, and the range of y over seeds.
struct ChartPoint {
  double x = 0, y = 0, low = 0, high = 0;
  int rows = 0;
  std::string label;
};

struct ChartLine {
  std::string name;                // of the method, and of the scene when there are several
  std::vector<ChartPoint> points;  // x rises, but where they have labels
};

// Those of all lines with one label.
std::vector<ChartPoint> points_of(const std::vector<ChartLine>& lines, const std::string& label);

// Lines in the order in which they appear. Renders that are limited by time end a little late, so
// seconds within 5 % of each other count as equal, before preprocessing is added; other columns
// have to be equal. Where points have labels, rows with one label are a point. Rows that
// logarithmic axes cannot show are left out with a warning. Throws Error naming file and row for a
// column that is missing and for cells that are no numbers.
std::vector<ChartLine> chart_lines(const ChartOptions& options, const RunControl& control);

}  // namespace waylight
