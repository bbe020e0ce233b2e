#include "libguide/guiding/flight_cells.h"

#include <cmath>
#include <optional>

namespace waylight {
namespace {

constexpr float kAlike = 0.5f;  // root of the mean squared relative difference

bool known(const ScatteredLight& light) { return light.radiance.front() >= 0; }

bool alike(const ScatteredLight& a, const ScatteredLight& b) {
  if (!known(a) || !known(b)) return known(a) == known(b);
  if (std::abs(a.direct_share - b.direct_share) > kAlike) return false;
  float sum = 0;
  for (size_t i = 0; i < a.radiance.size(); ++i) {
    const float both = a.radiance[i] + b.radiance[i];
    const float difference = both > 0 ? 2 * (a.radiance[i] - b.radiance[i]) / both : 0.0f;
    sum += difference * difference;
  }
  return sum <= kAlike * kAlike * static_cast<float>(a.radiance.size());
}

void pool(ScatteredLight& a, const ScatteredLight& b) {
  const float share = static_cast<float>(b.cells) / static_cast<float>(a.cells + b.cells);
  for (size_t i = 0; i < a.radiance.size(); ++i)
    a.radiance[i] += share * (b.radiance[i] - a.radiance[i]);
  a.direct_share += share * (b.direct_share - a.direct_share);
  a.cells += b.cells;
}

// The light of each node below which all cells are alike.
class AlikeNodes {
 public:
  AlikeNodes(std::span<const CacheNode> nodes, std::vector<ScatteredLight> light)
      : nodes_(nodes), light_(nodes.size()) {
    for (size_t i = nodes.size(); i-- > 0;)
      if (nodes[i].axis == kLeafAxis)
        light_[i] = std::move(light[nodes[i].child]);
      else
        merge_children(i);
  }

  FlightCells cells() {
    FlightCells result;
    result.nodes.emplace_back();
    add(0, 0, result);
    return result;
  }

 private:
  void merge_children(size_t node) {
    std::optional<ScatteredLight>& lower = light_[nodes_[node].child];
    std::optional<ScatteredLight>& upper = light_[nodes_[node].child + 1];
    if (!lower || !upper || !alike(*lower, *upper)) return;
    pool(*lower, *upper);
    light_[node] = std::move(lower);
    upper.reset();
  }
  void add(uint32_t node, size_t place, FlightCells& cells) {
    if (light_[node]) {
      cells.nodes[place].child = static_cast<uint32_t>(cells.light.size());
      cells.light.push_back(std::move(*light_[node]));
      return;
    }
    const CacheNode& split = nodes_[node];
    const auto first = static_cast<uint32_t>(cells.nodes.size());
    cells.nodes[place] = {split.split, first, split.axis};
    cells.nodes.resize(first + 2);
    add(split.child, first, cells);
    add(split.child + 1, first + 1, cells);
  }

  std::span<const CacheNode> nodes_;
  std::vector<std::optional<ScatteredLight>> light_;
};

}  // namespace

FlightCells merge_for_flights(std::span<const CacheNode> nodes, std::vector<ScatteredLight> light) {
  return AlikeNodes(nodes, std::move(light)).cells();
}

}  // namespace waylight
