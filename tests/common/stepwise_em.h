#pragma once

#include <utility>
#include <vector>

#include "libguide/directional/expectation_maximization.h"

namespace waylight::test {

// One mixture trained from a stream of batches by stepwise_update().
class StepwiseEm {
 public:
  // statistics: parallel to components, or empty before the first update.
  StepwiseEm(std::vector<GaussianComponent> components, std::vector<ComponentStatistics> statistics,
             float step)
      : components_(std::move(components)), statistics_(std::move(statistics)), step_(step) {
    statistics_.resize(components_.size());
  }

  void update(std::span<const WeightedPoint> batch, float samples, const MixturePrior& prior) {
    const StepwiseResult result =
        stepwise_update(components_, statistics_, step_, batch, samples, prior);
    components_.resize(result.count);
    statistics_.resize(result.count);
  }

  const std::vector<GaussianComponent>& components() const { return components_; }
  const std::vector<ComponentStatistics>& statistics() const { return statistics_; }
  float step() const { return step_; }

 private:
  std::vector<GaussianComponent> components_;
  std::vector<ComponentStatistics> statistics_;
  float step_;
};

}  // namespace waylight::test
