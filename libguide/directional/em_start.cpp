#include "libguide/directional/em_centres.h"
#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

std::vector<Vec2> first_centres(std::span<const WeightedPoint> points, const BatchWeights& weights,
                                int count) {
  std::vector<double> weight(points.size(), 0);
  for (size_t i = 0; i < points.size(); ++i)
    if (valid_point(points[i])) weight[i] = std::min(points[i].weight, weights.cap);
  return spread_centres<Vec2>(
      weight, [&](size_t i) { return points[i].y; }, count);
}

using Clusters = std::array<ComponentStatistics, kMaxEmComponents>;

// Statistics of the clusters of the nearest centre, normalised.
Clusters cluster(std::span<const WeightedPoint> points, const BatchWeights& weights,
                 std::span<const Vec2> centres) {
  std::array<Moments, kMaxEmComponents> moments{};
  for (const WeightedPoint& p : points) {
    if (!valid_point(p)) continue;
    const double w = std::min(p.weight, weights.cap);
    const int k = nearest(p.y, centres);
    const double x = p.y.x() - centres[k].x(), y = p.y.y() - centres[k].y();
    const Moments one = {w, w * x, w * y, w * x * x, w * x * y, w * y * y};
    for (size_t m = 0; m < one.size(); ++m) moments[k][m] += one[m];
  }
  Clusters result{};
  const double total = static_cast<double>(weights.used) / weights.scale;
  for (size_t k = 0; k < centres.size(); ++k)
    result[k] = statistics_of(moments[k], total, centres[k]);
  return result;
}

void move_to_means(std::span<const ComponentStatistics> clusters, std::span<Vec2> centres) {
  for (size_t k = 0; k < centres.size(); ++k)
    if (clusters[k].s0 > 0) centres[k] = Vec2(clusters[k].s1_x, clusters[k].s1_y) / clusters[k].s0;
}

std::vector<GaussianComponent> cluster_components(std::span<const WeightedPoint> points,
                                                  const BatchWeights& weights,
                                                  std::span<const Vec2> centres,
                                                  const MixturePrior& prior) {
  Clusters clusters = cluster(points, weights, centres);
  std::vector<GaussianComponent> components(centres.size());
  const std::span<ComponentStatistics> used(clusters.data(), centres.size());
  components.resize(maximization(used, weights.effective, prior, components));
  return components;
}

}  // namespace

std::vector<GaussianComponent> initial_components(std::span<const WeightedPoint> points, int count,
                                                  const MixturePrior& prior) {
  const BatchWeights weights = scan_weights(points, kMaxTrainingWeight);
  if (weights.used == 0) return {};
  std::vector<Vec2> centres =
      first_centres(points, weights, std::clamp(count, 1, kMaxEmComponents));
  for (int round = 0; round < kLloydRounds; ++round)
    move_to_means(cluster(points, weights, centres), centres);
  return cluster_components(points, weights, centres, prior);
}

std::vector<GaussianComponent> components_around(std::span<const WeightedPoint> points,
                                                 std::span<const Vec2> centres,
                                                 const MixturePrior& prior) {
  const BatchWeights weights = scan_weights(points, kMaxTrainingWeight);
  if (weights.used == 0 || centres.empty()) return {};
  return cluster_components(
      points, weights, centres.first(std::min<size_t>(centres.size(), kMaxEmComponents)), prior);
}

}  // namespace waylight
