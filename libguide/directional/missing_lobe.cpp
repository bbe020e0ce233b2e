#include "libguide/directional/missing_lobe.h"

#include <algorithm>
#include <cmath>

#include "libguide/directional/em_step.h"
#include "libguide/directional/gaussian_mixture.h"

namespace waylight {
namespace {

constexpr float kSmallestSide = 0.008f;
constexpr int kSizes = 5;  // each has twice the side of the one before
constexpr float kMinPoints = 3;

// Every second bit, from the lowest.
uint32_t spread_bits(uint32_t v) {
  v = (v | v << 8) & 0x00ff00ff;
  v = (v | v << 4) & 0x0f0f0f0f;
  v = (v | v << 2) & 0x33333333;
  return (v | v << 1) & 0x55555555;
}

// Bins of the next size are runs of four along the curve.
uint32_t bin_of(const Vec2& y) {
  const float lowest = -std::sqrt(kDiskMaxRadius2);
  const auto index = [&](float v) {
    return static_cast<uint32_t>(std::max((v - lowest) / kSmallestSide, 0.0f));
  };
  return spread_bits(index(y.x())) | spread_bits(index(y.y())) << 1;
}

// Log-likelihood of a Poisson number, per sample, by its mean being what was seen.
double poisson_gain(double seen, double expected) {
  return seen > expected ? seen * std::log(seen / expected) - seen + expected : 0;
}

}  // namespace

MissingLobes::MissingLobes(std::span<const WeightedPoint> points) {
  const BatchWeights weights = scan_weights(points, kMaxTrainingWeight);
  effective_ = weights.effective;
  for (const WeightedPoint& p : points)
    if (valid_point(p))
      points_.push_back(
          {bin_of(p.y), p.y,
           std::min(p.weight, weights.cap) * weights.scale / static_cast<float>(weights.used)});
  std::stable_sort(points_.begin(), points_.end(),
                   [](const Point& a, const Point& b) { return a.bin < b.bin; });
}

void MissingLobes::Bin::add(const Point& p) {
  const ComponentStatistics one{p.share, p.share * p.y.x(), p.share * p.y.y(), 0, 0, 0};
  statistics = blend(statistics, 1, one, 1);
  squares += sqr(p.share);
}

void MissingLobes::look_at(const Bin& bin, float side, const GaussianMixture& mixture,
                           Found& best) {
  if (bin.effective_points() < kMinPoints) return;
  const ComponentStatistics& s = bin.statistics;
  const double density = mixture.pdf({s.s1_x / s.s0, s.s1_y / s.s0});
  const double gain = poisson_gain(s.s0, std::max(density * sqr(side), 1e-12));
  if (gain > best.gain) best = {bin, gain};
}

std::optional<GaussianComponent> MissingLobes::find(std::span<const GaussianComponent> components,
                                                    const MixturePrior& prior) const {
  const GaussianMixture mixture(components);
  Found best;
  for (int size = 0; size < kSizes; ++size) {
    const float side = kSmallestSide * static_cast<float>(1 << size);
    for (size_t i = 0; i < points_.size();) {
      Bin bin;
      for (const uint32_t key = points_[i].bin >> 2 * size;
           i < points_.size() && points_[i].bin >> 2 * size == key; ++i)
        bin.add(points_[i]);
      look_at(bin, side, mixture, best);
    }
  }
  if (!(best.gain > 0)) return std::nullopt;
  GaussianComponent lobe;
  maximization(std::span(&best.bin.statistics, 1), effective_, prior, std::span(&lobe, 1));
  lobe.weight = best.bin.statistics.s0;
  return lobe;
}

}  // namespace waylight
