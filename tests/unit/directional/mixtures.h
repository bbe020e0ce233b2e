#pragma once
// Mixtures and quadrature that the tests of directional densities share.

#include <vector>

#include "libguide/base/sampler.h"
#include "libguide/directional/gaussian_mixture.h"

namespace waylight::test {

inline GaussianComponent component(float weight, const Vec2& mean, float sx, float sy, float rho) {
  return {weight, mean.x(), mean.y(), sx * sx, rho * sx * sy, sy * sy};
}

// Components about the unit disk, of widths between `narrow` and about 0.25.
inline std::vector<GaussianComponent> random_components(int count, uint64_t seed,
                                                        float narrow = 0.03f) {
  std::vector<GaussianComponent> result;
  for (int k = 0; k < count; ++k) {
    Sampler s(seed, 0, k);
    const Vec2 mean = 0.8f * square_to_disk(s.next_2d()), width = s.next_2d();
    result.push_back(component(0.1f + s.next(), mean, narrow + 0.22f * width.x(),
                               narrow + 0.22f * width.y(), 1.8f * (s.next() - 0.5f)));
  }
  return result;
}

inline double density(const GaussianComponent& c, const Vec2& y) {
  const double det = double(c.cov_xx) * c.cov_yy - double(c.cov_xy) * c.cov_xy;
  const double dx = double(y.x()) - c.mean_x, dy = double(y.y()) - c.mean_y;
  const double q = (c.cov_yy * dx * dx - 2 * c.cov_xy * dx * dy + c.cov_xx * dy * dy) / det;
  return std::exp(-0.5 * q) / (2 * std::numbers::pi * std::sqrt(det));
}

// Integral over |y|^2 <= radius2 by the midpoint rule.
template <typename Function>
double integrate_disk(const Function& f, double radius2 = kDiskMaxRadius2, int cells = 800) {
  const double half = std::sqrt(radius2), step = 2 * half / cells;
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double x = -half + (i + 0.5) * step, y = -half + (j + 0.5) * step;
      if (x * x + y * y <= radius2) sum += f(Vec2(x, y));
    }
  return sum * step * step;
}

// Points drawn from a mixture; those that leave the domain are left out.
inline std::vector<Vec2> draw(const GaussianMixture& mixture, int count, uint64_t seed) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    Sampler s(seed, 1, i);
    const float u = s.next();
    if (const std::optional<Vec2> y = mixture.sample(u, s.next_2d())) points.push_back(*y);
  }
  return points;
}

// The largest difference between the share of the points in a cell of an n x n grid over the domain
// and the integral of the density there, in standard deviations of a random share.
template <typename Function>
double worst_cell_deviation(const std::vector<Vec2>& points, int drawn, const Function& pdf) {
  constexpr int kCells = 12, kSub = 40;
  const double half = std::sqrt(double(kDiskMaxRadius2)), step = 2 * half / kCells;
  std::vector<int> seen(kCells * kCells, 0);
  for (const Vec2& y : points)
    ++seen[int((y.x() + half) / step) * kCells + int((y.y() + half) / step)];
  double worst = 0;
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    double mass = 0;
    for (int i = 0; i < kSub * kSub; ++i)
      mass += pdf(Vec2(-half + step * (cell / kCells + (i / kSub + 0.5) / kSub),
                       -half + step * (cell % kCells + (i % kSub + 0.5) / kSub)));
    mass *= step * step / (kSub * kSub);
    const double deviation = std::sqrt(std::max(mass * (1 - mass) * drawn, 1.0));
    worst = std::max(worst, std::abs(seen[cell] - mass * drawn) / deviation);
  }
  return worst;
}

}  // namespace waylight::test
