#include "libguide/transport/pixel_estimate.h"

#include <algorithm>
#include <array>

namespace waylight {
namespace {

constexpr int kRadius = 3;
constexpr float kMaxOverMedian = 2;
constexpr float kSpaceSigma = 1.5f, kNormalSigma = 0.3f, kAlbedoSigma = 0.1f;
constexpr float kDepthSigma = 0.1f;  // of the relative difference

// Median of the blocks around, those beyond the border left out.
float median_around(const Preview& preview, int x, int y) {
  std::array<float, 9> values;
  size_t count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, preview.rows - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, preview.columns - 1); ++i)
      values[count++] = preview.at(i, j).luminance;
  std::nth_element(values.begin(), values.begin() + count / 2, values.begin() + count);
  return values[count / 2];
}

float similarity(const PreviewBlock& a, const PreviewBlock& b) {
  const float depth = (a.depth - b.depth) / std::max({a.depth, b.depth, 1e-20f});
  const float exponent = (a.normal - b.normal).squaredNorm() / sqr(kNormalSigma) +
                         (a.albedo - b.albedo).square().sum() / sqr(kAlbedoSigma) +
                         sqr(depth) / sqr(kDepthSigma);
  return std::exp(-0.5f * exponent);
}

float filtered(const Preview& preview, const std::vector<float>& clamped, int x, int y) {
  float sum = 0, weights = 0;
  for (int j = std::max(y - kRadius, 0); j <= std::min(y + kRadius, preview.rows - 1); ++j)
    for (int i = std::max(x - kRadius, 0); i <= std::min(x + kRadius, preview.columns - 1); ++i) {
      const float space = std::exp(-0.5f * (sqr(i - x) + sqr(j - y)) / sqr(kSpaceSigma));
      const float weight = space * similarity(preview.at(x, y), preview.at(i, j));
      sum += weight * clamped[preview.index(i, j)];
      weights += weight;
    }
  return sum / weights;
}

}  // namespace

std::vector<float> filter_preview(const Preview& preview) {
  std::vector<float> clamped(preview.blocks.size()), result(preview.blocks.size());
  for (int y = 0; y < preview.rows; ++y)
    for (int x = 0; x < preview.columns; ++x)
      clamped[preview.index(x, y)] =
          std::min(preview.at(x, y).luminance, kMaxOverMedian * median_around(preview, x, y));
  for (int y = 0; y < preview.rows; ++y)
    for (int x = 0; x < preview.columns; ++x)
      result[preview.index(x, y)] = filtered(preview, clamped, x, y);
  return result;
}

PixelEstimates::PixelEstimates(const Preview& preview)
    : first_column_(preview.first_column),
      first_row_(preview.first_row),
      columns_(preview.columns),
      rows_(preview.rows),
      luminance_(filter_preview(preview)) {}

float PixelEstimates::at(int x, int y) const {
  if (luminance_.empty()) return 0;
  const auto in_blocks = [](int pixel, int first, int count) {
    return std::clamp((pixel + 0.5f) / Preview::kBlock - 0.5f - first, 0.0f, count - 1.0f);
  };
  const float u = in_blocks(x, first_column_, columns_), v = in_blocks(y, first_row_, rows_);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const auto row = [&](int r) {
    const float* values = &luminance_[static_cast<size_t>(r) * columns_];
    return std::lerp(values[i], values[std::min(i + 1, columns_ - 1)], u - i);
  };
  return std::lerp(row(j), row(std::min(j + 1, rows_ - 1)), v - j);
}

}  // namespace waylight
