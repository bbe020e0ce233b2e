#include "libguide/directional/em_centres.h"
#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

std::vector<Vec2> first_centres(std::span<const WeightedPoint> points, const BatchWeights& weights,
                                int count) {
  std::vector<double> weight(points.size(), 0);
  for (size_t i = 0; i < points.size(); ++i)
    if (valid_point(points[i])) weight[i] = std::min(points[i].weight, weights.cap);
  return spread_centres<Vec2>(weight, [&](size_t i) { return points[i].y; }, count);
}

// Statistics of the clusters of the nearest centre, normalised.
std::array<ComponentStatistics, kMaxEmComponents> cluster(std::span<const WeightedPoint> points,
                                                const BatchWeights& weights,
                                                std::span<const Vec2> centres) {
  std::array<ComponentStatistics, kMaxEmComponents> result{};
  for (const WeightedPoint& p : points) {
    if (!valid_point(p)) continue;
    const float w = std::min(p.weight, weights.cap) * weights.scale / weights.used;
    ComponentStatistics& s = result[nearest(p.y, centres)];
    s = blend(s, 1, {w, w * p.y.x(), w * p.y.y(), 0, 0, 0}, 1);
  }
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
  std::array<ComponentStatistics, kMaxEmComponents> clusters = cluster(points, weights, centres);
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
  std::vector<Vec2> centres = first_centres(points, weights, std::clamp(count, 1, kMaxEmComponents));
  for (int round = 0; round < kLloydRounds; ++round)
    move_to_means(cluster(points, weights, centres), centres);
  return cluster_components(points, weights, centres, prior);
}

std::vector<GaussianComponent> components_around(std::span<const WeightedPoint> points,
                                                 std::span<const Vec2> centres,
                                                 const MixturePrior& prior) {
  const BatchWeights weights = scan_weights(points, kMaxTrainingWeight);
  if (weights.used == 0 || centres.empty()) return {};
  return cluster_components(points, weights,
                            centres.first(std::min<size_t>(centres.size(), kMaxEmComponents)), prior);
}

}  // namespace waylight
