#pragma once
// The two halves of one EM iteration, shared by batch and stepwise EM.

#include <array>

#include "libguide/directional/expectation_maximization.h"
#include "libguide/math/lanes.h"

namespace waylight {

// How the weights of a batch are to be read.
struct BatchWeights {
  int used = 0, rejected = 0;  // points of weight 0 are neither
  float cap = 0;               // weights are cut here
  float scale = 0;             // 1 / the mean of the cut positive weights
  float effective = 0;         // (sum w)^2 / sum w^2 of the cut weights
};

bool valid_point(const WeightedPoint& point);
BatchWeights scan_weights(std::span<const WeightedPoint> points, float max_weight);

// Sufficient statistics of one pass over a batch, as in ComponentStatistics.
struct BatchStatistics {
  std::array<ComponentStatistics, kMaxEmComponents> components;
  double log_likelihood = 0;  // mean by weight, natural logarithm; only if asked for
};

// Eight points, so that no sum runs across lanes before the end. Those that are no valid points,
// and those that fill the last row up, have weight zero.
struct PointRow {
  Lanes x{}, y{}, weight{};
};
inline size_t row_count(size_t points) { return (points + kLanes - 1) / kLanes; }
void fill_rows(std::span<const WeightedPoint> points, const BatchWeights& weights,
               std::span<PointRow> rows);  // of row_count(points.size())

using Moments = std::array<double, 6>;  // 1, x, y, xx, xy, yy about an old mean

// One component in the form that the E-step needs.
struct Responsibility {
  float mean_x, mean_y, slope, inverse_a, inverse_b, log2_norm;

  Responsibility() = default;
  explicit Responsibility(const GaussianComponent& c);

  // log2 of weight times density. Subtracting the largest before the exponential keeps a point far
  // from all lobes with the nearest one.
  Lanes log2_density(Lanes x, Lanes y) const {
    const Lanes dx = x - mean_x;
    const Lanes a = dx * inverse_a, b = ((y - mean_y) - slope * dx) * inverse_b;
    return log2_norm - a * a - b * b;
  }
};

enum class Likelihood { skip, sum };

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

}  // namespace waylight
