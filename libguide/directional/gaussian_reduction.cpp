#include "libguide/directional/gaussian_reduction.h"

#include "libguide/directional/gaussian_mixture.h"

namespace waylight {
namespace {

double log_det(const GaussianComponent& c) {
  const double det =
      static_cast<double>(c.cov_xx) * c.cov_yy - static_cast<double>(c.cov_xy) * c.cov_xy;
  return std::log(std::max(det, 1e-30));
}

}  // namespace

GaussianComponent merge(const GaussianComponent& i, const GaussianComponent& j) {
  const double w = static_cast<double>(i.weight) + j.weight;
  const double a = i.weight / w, b = j.weight / w;
  const double dx = static_cast<double>(i.mean_x) - j.mean_x;
  const double dy = static_cast<double>(i.mean_y) - j.mean_y;
  return {static_cast<float>(w),
          static_cast<float>(a * i.mean_x + b * j.mean_x),
          static_cast<float>(a * i.mean_y + b * j.mean_y),
          static_cast<float>(a * i.cov_xx + b * j.cov_xx + a * b * dx * dx),
          static_cast<float>(a * i.cov_xy + b * j.cov_xy + a * b * dx * dy),
          static_cast<float>(a * i.cov_yy + b * j.cov_yy + a * b * dy * dy)};
}

double merge_cost(const GaussianComponent& i, const GaussianComponent& j) {
  const double cost = (static_cast<double>(i.weight) + j.weight) * log_det(merge(i, j)) -
                      i.weight * log_det(i) - j.weight * log_det(j);
  return std::max(0.5 * cost, 0.0);
}

ReductionResult reduce_mixture(std::span<const GaussianComponent> components,
                               const MergeLimit& limit, int max_components) {
  return reduce_greedily<GaussianMixture>(components, limit, max_components);
}

}  // namespace waylight
