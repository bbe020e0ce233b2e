#include "libguide/base/sampler.h"
#include "libguide/directional/em_step.h"

namespace waylight {
namespace {

constexpr uint64_t kStartSeed = 0x5eed;
constexpr int kLloydRounds = 3;

// The point at which the running sum of `weights` reaches the fraction u of their total; -1 where
// they are all zero.
int pick(std::span<const double> weights, double u) {
  double total = 0, sum = 0;
  for (double w : weights) total += w;
  if (!(total > 0)) return -1;
  int last = -1;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    last = static_cast<int>(i);
    sum += weights[i];
    if (sum > u * total) break;
  }
  return last;
}

// k-means++ [Arthur, Vassilvitskii 2007]: each next centre by weight times squared distance.
std::vector<Vec2> spread_centres(std::span<const WeightedPoint> points, const BatchWeights& weights,
                                 int count) {
  std::vector<double> cost(points.size(), 0);
  for (size_t i = 0; i < points.size(); ++i)
    if (valid_point(points[i])) cost[i] = std::min(points[i].weight, weights.cap);
  const std::vector<double> weight = cost;
  std::vector<double> distance2(points.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec2> centres;
  for (int k = 0; k < count; ++k) {
    const int chosen = pick(cost, Sampler(kStartSeed, 0, k).next());
    if (chosen < 0) break;
    centres.push_back(points[chosen].y);
    for (size_t i = 0; i < points.size(); ++i) {
      if (!(weight[i] > 0)) continue;
      distance2[i] = std::min<double>(distance2[i], (points[i].y - centres.back()).squaredNorm());
      cost[i] = weight[i] * distance2[i];
    }
  }
  return centres;
}

int nearest(const Vec2& y, std::span<const Vec2> centres) {
  int best = 0;
  for (size_t k = 1; k < centres.size(); ++k)
    if ((y - centres[k]).squaredNorm() < (y - centres[best]).squaredNorm())
      best = static_cast<int>(k);
  return best;
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
  std::vector<Vec2> centres = spread_centres(points, weights, std::clamp(count, 1, kMaxEmComponents));
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
