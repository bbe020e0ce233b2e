#pragma once
// First centres for EM by k-means++, over the plane or over unit directions: the squared chord
// between two of these is 2 (1 - cos), the distance of spherical k-means.

#include <limits>
#include <span>
#include <vector>

#include "libguide/base/sampler.h"

namespace waylight {

inline constexpr uint64_t kStartSeed = 0x5eed;
inline constexpr int kLloydRounds = 3;

// The point at which the running sum of `weights` reaches the fraction u of their total; -1 where
// they are all zero.
inline int pick(std::span<const double> weights, double u) {
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

// k-means++ [Arthur, Vassilvitskii 2007]: each next centre by weight times squared distance. Points
// of weight 0 are not looked at. With fewer distinct points than `count`, fewer centres.
template <typename Place, typename PlaceOf>
std::vector<Place> spread_centres(std::span<const double> weight, const PlaceOf& place_of,
                                  int count) {
  std::vector<double> cost(weight.begin(), weight.end());
  std::vector<double> distance2(weight.size(), std::numeric_limits<double>::infinity());
  std::vector<Place> centres;
  for (int k = 0; k < count; ++k) {
    const int chosen = pick(cost, Sampler(kStartSeed, 0, k).next());
    if (chosen < 0) break;
    centres.push_back(place_of(chosen));
    for (size_t i = 0; i < weight.size(); ++i) {
      if (!(weight[i] > 0)) continue;
      distance2[i] = std::min<double>(distance2[i], (place_of(i) - centres.back()).squaredNorm());
      cost[i] = weight[i] * distance2[i];
    }
  }
  return centres;
}

template <typename Place>
int nearest(const Place& place, std::span<const Place> centres) {
  int best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (size_t k = 0; k < centres.size(); ++k) {
    const float distance2 = (place - centres[k]).squaredNorm();
    if (!(distance2 < least)) continue;
    least = distance2;
    best = static_cast<int>(k);
  }
  return best;
}

}  // namespace waylight
