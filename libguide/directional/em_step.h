#pragma once
// The two halves of one EM iteration, shared by batch and stepwise EM.

#include <array>

#include "libguide/directional/em_batch.h"
#include "libguide/directional/expectation_maximization.h"

namespace waylight {

bool valid_point(const WeightedPoint& point);
BatchWeights scan_weights(std::span<const WeightedPoint> points, float max_weight);

// Sufficient statistics of one pass over a batch, as in ComponentStatistics.
struct BatchStatistics {
  std::array<ComponentStatistics, kMaxEmComponents> components;
  double log_likelihood = 0;  // mean by weight, natural logarithm; only if asked for
};

// Eight points. Those that are no valid points, and those that fill the last row up, have weight
// zero.
struct PointRow {
  Lanes x{}, y{}, weight{};
};
void fill_rows(std::span<const WeightedPoint> points, const BatchWeights& weights,
               std::span<PointRow> rows);  // of row_count(points.size())

using Moments = std::array<double, 6>;  // sums of 1, x, y, xx, xy, yy about some origin

// Statistics of a component from moments about `origin`, as shares of `total`.
ComponentStatistics statistics_of(const Moments& sums, double total, const Vec2& origin);

// One component in the form that the E-step needs.
struct Responsibility {
  float mean_x, mean_y, slope, inverse_a, inverse_b, log2_norm;

  Responsibility() = default;
  explicit Responsibility(const GaussianComponent& c);

  // Of weight times density.
  Lanes log2_density(const PointRow& row) const {
    const Lanes dx = row.x - mean_x;
    const Lanes a = dx * inverse_a, b = ((row.y - mean_y) - slope * dx) * inverse_b;
    return log2_norm - a * a - b * b;
  }
};

// The E-step over a batch, block by block.
class Expectation {
 public:
  Expectation(std::span<const GaussianComponent> components, Likelihood likelihood);
  void add(std::span<const PointRow> rows);
  BatchStatistics finish() const;

 private:
  std::span<const GaussianComponent> components_;
  Likelihood likelihood_;
  std::array<Responsibility, kMaxEmComponents> model_;
  std::array<Moments, kMaxEmComponents> moments_{};
  double log2_likelihood_ = 0;
};

// keep * a + add * b of moments about their own means.
ComponentStatistics blend(const ComponentStatistics& a, float keep, const ComponentStatistics& b,
                          float add);

// Components of the statistics with n = samples (at least 1); those without support are left out of
// both, the others moved to the front. Returns how many are left.
int maximization(std::span<ComponentStatistics> statistics, float samples,
                 const MixturePrior& prior, std::span<GaussianComponent> components);

// Moves components from where an M-step has taken them on in the same direction, to `step` times
// the way: near a maximum, EM in steps of up to 2 still converges, and sooner [Peters, Walker
// 1978]. Weights that fall do so by the same factor again, so that none is lost, and sum to 1.
// Components whose covariance would all but vanish, and all where some were lost, stay.
void over_relax(std::span<const GaussianComponent> before, float step,
                std::span<GaussianComponent> components);

}  // namespace waylight
