#include "libguide/directional/vmf_reduction.h"

#include "libguide/directional/vmf_mixture.h"

namespace waylight {
namespace {

// In double: that a float mean is 6e-8 short would make merges of equal lobes cost something.
Eigen::Vector3d mean_direction(const VmfComponent& c) {
  return mean_cosine(c.kappa) * c.mean.cast<double>().normalized();
}

}  // namespace

VmfComponent merge(const VmfComponent& i, const VmfComponent& j) {
  const double w = static_cast<double>(i.weight) + j.weight;
  const Eigen::Vector3d resultant =
      i.weight / w * mean_direction(i) + j.weight / w * mean_direction(j);
  const double length = resultant.norm();
  VmfComponent merged = {static_cast<float>(w), i.mean, 0};
  merged.kappa = static_cast<float>(kappa_of_mean_cosine(length));
  if (length > 1e-30) merged.mean = (resultant / length).cast<float>();
  return merged;
}

double vmf_entropy(double kappa) {
  constexpr double kLog4Pi = 2.5310242469692907;
  if (kappa < 1e-6) return kLog4Pi;
  const double log_norm = std::log(2 * kappa) - std::log(-std::expm1(-2 * kappa)) - kLog4Pi;
  return kappa * (1 - mean_cosine(kappa)) - log_norm;
}

double merge_cost(const VmfComponent& i, const VmfComponent& j) {
  const double cost = (static_cast<double>(i.weight) + j.weight) * vmf_entropy(merge(i, j).kappa) -
                      i.weight * vmf_entropy(i.kappa) - j.weight * vmf_entropy(j.kappa);
  return std::max(cost, 0.0);
}

VmfReductionResult reduce_vmf_mixture(std::span<const VmfComponent> components,
                                      const MergeLimit& limit, int max_components) {
  return reduce_greedily<VmfMixture>(components, limit, max_components);
}

}  // namespace waylight
