#pragma once
// Fewer components for a mixture by greedy merging, whatever its components are: those that have a
// merge(i, j) and a merge_cost(i, j) whose sum over successive merges does not depend on their
// order.

#include <limits>
#include <span>
#include <vector>

namespace waylight {

template <typename Component>
struct Reduction {
  std::vector<Component> components;  // weights normalised
  double cost = 0;                    // of the merges made, for weights that sum to 1
  double collapse_cost = 0;           // of merging all into one
  double percent() const { return collapse_cost > 0 ? 100 * cost / collapse_cost : 0; }
};

inline constexpr double kMergeRounding = 1e-7;  // nats: equal components merge although sums round

struct MergePair {
  size_t i = 0, j = 0;
  double cost = std::numeric_limits<double>::infinity();
};

template <typename Component>
MergePair cheapest_pair(const std::vector<Component>& components) {
  MergePair best;
  for (size_t i = 0; i < components.size(); ++i)
    for (size_t j = i + 1; j < components.size(); ++j) {
      const double cost = merge_cost(components[i], components[j]);
      if (cost < best.cost) best = {i, j, cost};
    }
  return best;
}

// Of any sequence of merges that ends at one component.
template <typename Component>
double collapse_cost(std::span<const Component> components) {
  Component whole = components[0];
  double cost = 0;
  for (const Component& c : components.subspan(1)) {
    cost += merge_cost(whole, c);
    whole = merge(whole, c);
  }
  return cost;
}

// Those that the mixture for sampling would not leave out, weights normalised.
template <typename Mixture, typename Component>
std::vector<Component> valid_components(std::span<const Component> components) {
  std::vector<Component> result;
  double total = 0;
  for (const Component& c : components) {
    if (Mixture(std::span(&c, 1)).count() == 0) continue;
    result.push_back(c);
    total += c.weight;
  }
  for (Component& c : result) c.weight = static_cast<float>(c.weight / total);
  return result;
}

// Parameters that a merge of two lobes saves: a weight, and mean and covariance of a Gaussian or
// mean and concentration of a von Mises-Fisher lobe.
constexpr int kGaussianParameters = 6, kVmfParameters = 4;

// How much merging may cost in all: a part of collapse_cost, and so much for each merge.
struct MergeLimit {
  MergeLimit(float percent_of_collapse) : percent(percent_of_collapse) {}
  // The merges that n samples cannot tell from none, by Akaike's information criterion [1974]: a
  // merge loses n times its cost of log-likelihood and saves `parameters`. The Bayesian criterion
  // merges more, and images got noisier by 3 to 8 %.
  static MergeLimit by_evidence(double samples, int parameters) {
    MergeLimit limit(0);
    limit.nats_per_merge = parameters / samples;
    return limit;
  }

  float percent;
  double nats_per_merge = 0;
};

// Merges the cheapest pair while the accumulated cost stays below the limit, and on until no more
// than max_components (>= 1) are left.
template <typename Mixture, typename Component>
Reduction<Component> reduce_greedily(std::span<const Component> components, MergeLimit limit,
                                     int max_components) {
  Reduction<Component> result;
  result.components = valid_components<Mixture>(components);
  std::vector<Component>& left = result.components;
  if (left.size() < 2) return result;
  result.collapse_cost = collapse_cost(std::span<const Component>(left));
  double most = limit.percent / 100 * result.collapse_cost + kMergeRounding;
  while (left.size() > 1) {
    const MergePair pair = cheapest_pair(left);
    const bool too_many = left.size() > static_cast<size_t>(max_components);
    most += limit.nats_per_merge;
    if (!too_many && result.cost + pair.cost > most) break;
    result.cost += pair.cost;
    left[pair.i] = merge(left[pair.i], left[pair.j]);
    left.erase(left.begin() + pair.j);
  }
  return result;
}

}  // namespace waylight
