#include "libguide/cache/escape_histogram.h"

#include <algorithm>

namespace waylight {

EscapeHistogram::EscapeHistogram(const GuideCache& previous) {
  for (size_t i = 0; i < previous.escape_weights.size(); ++i)
    weight(previous.escape_bins[i / EscapeMap::kCells], i % EscapeMap::kCells) =
        double{previous.escape_weights[i]} * static_cast<double>(previous.emitted);
}

double& EscapeHistogram::weight(uint32_t bin, uint32_t cell) {
  if (weights_.empty()) weights_.resize(size_t{EscapeMap::kBins} * EscapeMap::kCells);
  return weights_[size_t{bin} * EscapeMap::kCells + cell];
}

void EscapeHistogram::add(const EscapeMap& map, const Escape& escape, float emitted) {
  const Vec2 position = map.position(escape.origin, escape.direction);
  weight(EscapeMap::bin(escape.direction), EscapeMap::cell(position)) +=
      luminance(escape.power) * emitted;
}

void EscapeHistogram::store(GuideCache& cache) const {
  cache.escape_bins.clear();
  cache.escape_weights.clear();
  const double scale = 1 / static_cast<double>(std::max<uint64_t>(cache.emitted, 1));
  for (size_t bin = 0; bin * EscapeMap::kCells < weights_.size(); ++bin) {
    const std::span<const double> cells =
        std::span(weights_).subspan(bin * EscapeMap::kCells, EscapeMap::kCells);
    if (std::all_of(cells.begin(), cells.end(), [](double w) { return w == 0; })) continue;
    cache.escape_bins.push_back(static_cast<uint32_t>(bin));
    for (const double w : cells) cache.escape_weights.push_back(static_cast<float>(w * scale));
  }
}

}  // namespace waylight
