#include "libguide/directional/gaussian_reduction.h"

#include "libguide/directional/gaussian_mixture.h"

namespace waylight {
namespace {

constexpr double kRounding = 1e-7;  // nats: equal components merge although the sums round

double log_det(const GaussianComponent& c) {
  const double det =
      static_cast<double>(c.cov_xx) * c.cov_yy - static_cast<double>(c.cov_xy) * c.cov_xy;
  return std::log(std::max(det, 1e-30));
}

std::vector<GaussianComponent> normalised(std::span<const GaussianComponent> components) {
  std::vector<GaussianComponent> result;
  double total = 0;
  for (const GaussianComponent& c : components) {
    if (GaussianMixture(std::span(&c, 1)).count() == 0) continue;
    result.push_back(c);
    total += c.weight;
  }
  for (GaussianComponent& c : result) c.weight = static_cast<float>(c.weight / total);
  return result;
}

struct Pair {
  size_t i = 0, j = 0;
  double cost = std::numeric_limits<double>::infinity();
};

Pair cheapest_pair(std::span<const GaussianComponent> components) {
  Pair best;
  for (size_t i = 0; i < components.size(); ++i)
    for (size_t j = i + 1; j < components.size(); ++j) {
      const double cost = merge_cost(components[i], components[j]);
      if (cost < best.cost) best = {i, j, cost};
    }
  return best;
}

// The bounds telescope: the cost of any sequence of merges that ends at one component.
double collapse_cost(std::span<const GaussianComponent> components) {
  GaussianComponent whole = components[0];
  double cost = 0;
  for (const GaussianComponent& c : components.subspan(1)) {
    cost += merge_cost(whole, c);
    whole = merge(whole, c);
  }
  return cost;
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

ReductionResult reduce_mixture(std::span<const GaussianComponent> components, float max_cost,
                               int max_components) {
  ReductionResult result;
  result.components = normalised(components);
  std::vector<GaussianComponent>& left = result.components;
  if (left.size() < 2) return result;
  result.collapse_cost = collapse_cost(left);
  const double limit = max_cost / 100 * result.collapse_cost + kRounding;
  while (left.size() > 1) {
    const Pair pair = cheapest_pair(left);
    const bool too_many = left.size() > static_cast<size_t>(max_components);
    if (!too_many && result.cost + pair.cost > limit) break;
    result.cost += pair.cost;
    left[pair.i] = merge(left[pair.i], left[pair.j]);
    left.erase(left.begin() + pair.j);
  }
  return result;
}

}  // namespace waylight
