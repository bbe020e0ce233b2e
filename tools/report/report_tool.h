#pragma once

#include <string>
#include <vector>

#include "tools/common/cli.h"

namespace waylight {

struct ReportOptions {
  std::vector<std::string> tables;  // CSV of image-compare
  std::string output;               // HTML
  std::string title = "Speed against accuracy";
  std::string base;                 // method to compare with; empty: the first of each scene
  std::string csv;                  // table of the times to reach, empty: none
  std::vector<std::string> charts;  // SVG files to show at the end
  std::string stability;            // CSV of pipelines/stability.mk, empty: none
  std::vector<int> crop;            // x, y, width, height; empty: by the methods' errors
  int width = 480;                  // most pixels of a picture in a row, 64..4096
  float exposure = 0;               // stops

  void validate() const;
};

void declare(CLI::App& app, ReportOptions& options);  // the command line

// Writes the report, and prints how soon each method has the error that the first has at its end.
void report(const ToolRun& run, const ReportOptions& options);

}  // namespace waylight
