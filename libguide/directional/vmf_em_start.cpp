#include "libguide/directional/em_centres.h"
#include "libguide/directional/vmf_em_step.h"

namespace waylight {
namespace {

using Clusters = std::array<VmfStatistics, kMaxEmComponents>;

// Of valid directions, cut; of others 0.
std::vector<double> cut_weights(std::span<const WeightedDirection> points,
                                const BatchWeights& weights) {
  std::vector<double> result(points.size(), 0);
  for (size_t i = 0; i < points.size(); ++i)
    if (valid_direction(points[i])) result[i] = std::min(points[i].weight, weights.cap);
  return result;
}

// Statistics of the clusters of the nearest centre, normalised; summed in double.
Clusters cluster(std::span<const WeightedDirection> points, std::span<const double> weight,
                 std::span<const Vec3> centres) {
  std::array<Eigen::Vector4d, kMaxEmComponents> sums;
  sums.fill(Eigen::Vector4d::Zero());
  double total = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!(weight[i] > 0)) continue;
    const Vec3& w = points[i].w;
    sums[nearest(w, centres)] += weight[i] * Eigen::Vector4d(1, w.x(), w.y(), w.z());
    total += weight[i];
  }
  Clusters result{};
  for (size_t k = 0; k < centres.size(); ++k)
    result[k] = {static_cast<float>(sums[k][0] / total), (sums[k].tail<3>() / total).cast<float>()};
  return result;
}

void move_to_means(const Clusters& clusters, std::span<Vec3> centres) {
  for (size_t k = 0; k < centres.size(); ++k) {
    const float length = clusters[k].s1.norm();
    if (length > 1e-6f * clusters[k].s0) centres[k] = clusters[k].s1 / length;
  }
}

}  // namespace

std::vector<VmfComponent> initial_vmf_components(std::span<const WeightedDirection> points,
                                                 int count, const VmfPrior& prior) {
  const BatchWeights weights = scan_weights(points, kMaxTrainingWeight);
  if (weights.used == 0) return {};
  const std::vector<double> weight = cut_weights(points, weights);
  std::vector<Vec3> centres =
      spread_centres<Vec3>(weight, [&](size_t i) { return points[i].w; },
                           std::clamp(count, 1, kMaxEmComponents));
  for (int round = 0; round < kLloydRounds; ++round)
    move_to_means(cluster(points, weight, centres), centres);
  Clusters clusters = cluster(points, weight, centres);
  std::vector<VmfComponent> components(centres.size());
  const std::span used(clusters.data(), centres.size());
  components.resize(maximization(used, weights.effective, prior, components));
  return components;
}

}  // namespace waylight
