#pragma once
// The figures of a comparison as text.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "libguide/image/compare.h"
#include "libguide/image/z_scores.h"
#include "tools/image-compare/compare_tool.h"

namespace waylight {

struct ComparisonReport {
  CompareFigures figures;
  std::vector<double> relmse_of_each;  // of several renders
  std::optional<ZScores> z;
};

void print_table(const ToolRun& run, const ComparisonReport& report);
nlohmann::ordered_json to_json(const ImageLabels& labels, const ComparisonReport& report);

}  // namespace waylight
