#pragma once
// The part of a cache that is of media: a tree over position whose cells hold mixtures over the
// sphere of the directions that light comes from.

#include <cstdint>
#include <vector>

#include "libguide/math/types.h"
#include "libguide/records/focused_lobe.h"
#include "libguide/records/vmf.h"
#include "libguide/spatial/orientation_tree.h"

namespace waylight {

// The mixture of one kind of light in a cell, and its fluence, the integral of radiance over the
// sphere (W/m^2, luminance).
struct MediumLight {
  float fluence = 0;
  float photon_count = 0;       // photons that the mixture saw, half of its parent's included
  float effective_samples = 0;  // (sum w)^2 / sum w^2 of their weights
  uint32_t first_component = 0;
  uint32_t component_count = 0;
};

// Direct light comes straight from an emitter, through media only: next-event estimation samples
// it, so directions are guided by the indirect light alone. Where along a ray to scatter depends on
// both.
struct MediumCell {
  MediumLight indirect, direct;
};

// What one kind of light in a cell needs to go on training; see CellTraining.
struct MediumLightTraining {
  double flux = 0;  // sum of weights since the cell was made
  float step = 0;
  float samples = 0;
  double weight_sum = 0, weight_sum2 = 0;
};

struct MediumTraining {
  // Of the photons since the cell was made: means, sums of squared deviations, and sums of their
  // products xy, xz, yz.
  Vec3 position_mean = Vec3::Zero(), position_m2 = Vec3::Zero(), position_cross = Vec3::Zero();
  float count = 0;
  double born = 0;             // photons of the whole training when the cell was made
  uint64_t occupied = 0;       // of 4 x 4 x 4 parts of its box, x first: those that held a photon
  float inherited_volume = 0;  // share of the parent's, until the cell's own is known
  MediumLightTraining indirect, direct;
};

struct MediumCache {
  uint64_t emitted = 0;          // particles of the streams that held photons of media
  uint64_t photons = 0;          // of media, in all streams, refused ones included
  std::vector<CacheNode> nodes;  // axes 0..2 only
  std::vector<MediumCell> cells;
  std::vector<VmfComponent> components;
  std::vector<VmfStatistics> statistics;  // parallel to components, or empty
  std::vector<MediumTraining> training;   // parallel to cells, or empty
  // Of the cells whose indirect light comes from places, by cell: what directions are guided by in
  // place of its components.
  std::vector<FocusedCell> focused_cells;
  std::vector<FocusedLobe> focused_lobes;
};

}  // namespace waylight
