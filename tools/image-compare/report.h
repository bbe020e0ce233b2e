#pragma once
// The figures of a comparison as text.

#include <optional>

#include "libguide/image/compare.h"
#include "libguide/image/z_scores.h"
#include "tools/image-compare/compare_tool.h"

namespace waylight {

struct ComparisonReport {
  CompareFigures figures;
  std::optional<ZScores> z;
};

// Both print on stdout.
void print_table(const ComparisonReport& report);
void print_json(const ImageLabels& labels, const ComparisonReport& report);

}  // namespace waylight
