#include "tools/render/segment_table.h"

#include <fmt/format.h>

#include <numeric>

#include "formats/atomic_file.h"
#include "tools/common/csv.h"

namespace waylight {
namespace {

int last_reached(const SegmentSums& sums) {
  int last = 0;
  for (int i = 0; i < SegmentSums::kCount; ++i)
    if (sums.reached[i] > 0 || sums.luminance[i] != 0) last = i;
  return last;
}

}  // namespace

void write_segment_table(const std::string& path, const std::string& scene,
                         const std::string& method, const SegmentSums& sums) {
  const double total = std::accumulate(sums.luminance.begin(), sums.luminance.end(), 0.0);
  const double samples = sums.samples > 0 ? static_cast<double>(sums.samples) : 1;
  std::string text = "scene,method,edges,reach,contribution,cumulative\n";
  double cumulative = 0;
  for (int i = 0; i <= last_reached(sums); ++i) {
    const double share = total > 0 ? sums.luminance[i] / total : 0;
    cumulative += share;
    const double reach = static_cast<double>(sums.reached[i]) / samples;
    text += csv_line({scene, method, std::to_string(i + 1), fmt::format("{:.6g}", reach),
                      fmt::format("{:.6g}", share), fmt::format("{:.6g}", cumulative)});
  }
  write_text_atomically(path, text);
}

}  // namespace waylight
