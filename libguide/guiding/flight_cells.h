#pragma once
// The cells of a cache's media as flights see them.

#include <span>
#include <vector>

#include "libguide/spatial/orientation_tree.h"

namespace waylight {

// What a cell, or several that are alike, scatter.
struct ScatteredLight {
  std::vector<float> radiance;  // table by table; negative where nothing is known
  float direct_share = 0;       // of the fluence, what comes straight from emitters, in [0, 1]
  int cells = 1;
};

// Directions are guided by all cells that the photons could tell apart. A flight asks every cell
// along it for one number and needs no more of them than there are differences in these: siblings
// become one where they scatter alike, so there are fewer bins along a ray and smaller tables.
struct FlightCells {
  std::vector<CacheNode> nodes;       // leaves are indices of `light`
  std::vector<ScatteredLight> light;  // depth first, so that neighbours in space are near
};

// nodes: valid (check_tree) and not empty; light: of its cells, tables of one size.
FlightCells merge_for_flights(std::span<const CacheNode> nodes, std::vector<ScatteredLight> light);

}  // namespace waylight
