#pragma once
// Where a mixture misses a lobe.

#include <optional>
#include <span>
#include <vector>

#include "libguide/directional/em_batch.h"
#include "libguide/directional/expectation_maximization.h"

namespace waylight {

class GaussianMixture;

// Looks at points of the disk in bins of two thirds of a degree to ten degrees.
class MissingLobes {
 public:
  // Weights are cut as in EmOptions.
  explicit MissingLobes(std::span<const WeightedPoint> points);

  // The Gaussian of the points of that bin in which they most outnumber, by likelihood, what the
  // mixture expects; its weight is their share of all. Bins of fewer than three effective points do
  // not count. Empty where no bin has more than is expected.
  std::optional<GaussianComponent> find(std::span<const GaussianComponent> components,
                                        const MixturePrior& prior) const;

  double samples() const { return effective_; }  // effective number of the points

 private:
  struct Point {
    uint32_t bin;  // of the smallest size, along a Morton curve
    Vec2 y;
    float share;  // of all weights
  };
  struct Bin {
    ComponentStatistics statistics{};  // of points with the shares as weights
    float squares = 0;                 // of the shares, summed

    void add(const Point& point);
    float effective_points() const { return statistics.s0 * statistics.s0 / squares; }
  };
  struct Found {
    Bin bin;
    double gain = 0;  // nats a sample
  };

  static void look_at(const Bin& bin, float side, const GaussianMixture& mixture, Found& best);

  std::vector<Point> points_;  // in the order of bins
  float effective_ = 0;
};

}  // namespace waylight
