#include "libguide/guiding/escape_tables.h"

#include <numeric>

namespace waylight {
namespace {

constexpr int kSide = EscapeMap::kPositions;

// Weights 1 2 1 along each axis.
std::vector<float> smoothed(std::span<const float> cells) {
  std::vector<float> result(cells.size());
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int column = std::clamp(x + dx, 0, kSide - 1);
          const int row = std::clamp(y + dy, 0, kSide - 1);
          const int weight = (2 - std::abs(dx)) * (2 - std::abs(dy));
          result[y * kSide + x] += static_cast<float>(weight) * cells[row * kSide + column];
        }
  return result;
}

}  // namespace

EscapeTables::EscapeTables(const GuideCacheView& importance) : bins_(1) {
  if (importance.escape_bins.empty()) return;
  const EscapeMap map(importance.scene_bounds);
  const float scale = 1 / (EscapeMap::kBinSolidAngle * map.disk_area());
  index_.assign(EscapeMap::kBins, 0);
  for (size_t i = 0; i < importance.escape_bins.size(); ++i) {
    const std::span<const float> cells =
        importance.escape_weights.subspan(i * EscapeMap::kCells, EscapeMap::kCells);
    index_[importance.escape_bins[i]] = static_cast<int>(bins_.size());
    const float sum = std::accumulate(cells.begin(), cells.end(), 0.0f);
    bins_.push_back({PrimaryTable(smoothed(cells), 1, kSide), sum * scale});
  }
}

const EscapeTables::Bin& EscapeTables::bin_of(const Vec3& to_light) const {
  return bins_[index_.empty() ? 0 : index_[EscapeMap::bin(to_light)]];
}

float EscapeTables::importance(const Vec3& to_light) const { return bin_of(to_light).importance; }

Vec2 EscapeTables::sample(const Vec3& to_light, float u, const Vec2& u2) const {
  return bin_of(to_light).places.sample(u, u2).v;
}

float EscapeTables::pdf(const Vec3& to_light, const Vec2& position) const {
  return bin_of(to_light).places.pdf({0, position});
}

}  // namespace waylight
