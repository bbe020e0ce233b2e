#pragma once
// Illumination cache: a tree over position and surface orientation whose cells hold mixtures.

#include <cstdint>
#include <vector>

#include "libguide/math/types.h"
#include "libguide/records/gaussian.h"
#include "libguide/records/medium_cache.h"
#include "libguide/records/quantity.h"
#include "libguide/spatial/orientation_tree.h"

namespace waylight {

struct CacheCell {
  Vec3 normal =
      Vec3::UnitZ();       // of the cell's frame: Frame(normal); the mixture's plane is its disk
  float irradiance = 0;    // W/m^2, luminance, estimated from the photon power per surface area
  float photon_count = 0;  // photons behind the mixture: its own, or half of its parent's too
  float effective_samples = 0;  // (sum w)^2 / sum w^2 of their weights
  float guided_mass = 0;        // share of the mixture's mass inside the domain
  uint32_t first_component = 0;
  uint32_t component_count = 0;
};

// Where the photons of a cell came from, with some room: beyond, in a part of its leaf that no
// photon reached, it says nothing. A cell ends else only where another one begins: the dark side of
// a wall would be guided by what was learned on the lit one.
struct CellReach {
  Vec3 min = Vec3::Constant(-kInfinity), max = Vec3::Constant(kInfinity);

  bool holds(const Vec3& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
};

// The decayed sufficient statistics of one component, kept so that training can go on: s0 its share
// of the weight (they sum to 1 over a mixture), s1 = s0 mean, s2 the second moments about the mean,
// times s0. Moments about the origin would cancel in float for lobes narrower than a degree.
// Dropped by reduction.
struct ComponentStatistics {
  float s0 = 0, s1_x = 0, s1_y = 0, s2_xx = 0, s2_xy = 0, s2_yy = 0;
};

// What one cell needs to go on training. A photon's weight is the luminance of its power times the
// particles that its stream emitted, so that streams of any length stand on one footing.
struct CellTraining {
  // Of the photons since the cell was made: means, sums of squared deviations, and for the position
  // sums of their products xy, xz, yz.
  Vec3 position_mean = Vec3::Zero(), position_m2 = Vec3::Zero(), position_cross = Vec3::Zero();
  Vec3 normal_mean = Vec3::Zero(), normal_m2 = Vec3::Zero();
  float count = 0;
  // Sum of weights since the cell was made, and photons of the whole training when it was made. A
  // cell made by a split of the position begins as if it had seen a few photons like its parent's.
  double flux = 0;
  double born = 0;
  float inherited_area = 0;  // share of the parent's area, until the cell's own is known
  float step = 0;            // stepwise-EM updates made so far; 0 is no mixture yet
  float samples = 0;         // effective number of photons that the EM statistics stand for
  // Sums over the photons that the mixture saw, half of the parent's included.
  double weight_sum = 0, weight_sum2 = 0;
};

// What photons and camera paths each say of a cell, where there are camera paths: sums of weights,
// of the weights that the mixture takes (as a rule those of indirect light), and of the squares of
// these; how many samples of camera paths the mixture took, and how many looked for light. A
// sample's weight is the luminance of its irradiance. Of those since the cell was made, and of a
// few of its parent's.
struct CellSources {
  double light_all = 0, light_guided = 0, light_guided2 = 0;
  double camera_all = 0, camera_guided = 0, camera_guided2 = 0;
  float camera_samples = 0, camera_looks = 0;
};

// Where "light" and "photons" are said of a cache, importance and importons are meant where it
// holds importance: its irradiance is then int W cos, 1/m^2.
struct GuideCache {
  Quantity quantity = Quantity::radiance;
  Bounds scene_bounds;
  uint64_t emitted = 0;  // particles behind the whole training
  uint32_t passes = 0;   // photon streams consumed
  uint64_t photons = 0;  // photons in these streams, refused ones included
  uint64_t paths = 0;    // camera paths whose samples were among the photons
  std::vector<CacheNode> nodes;
  std::vector<CacheCell> cells;
  std::vector<CellReach> reaches;  // by cell; empty: all have any
  std::vector<GaussianComponent> components;
  std::vector<ComponentStatistics> statistics;  // parallel to components, or empty
  std::vector<CellTraining> training;           // parallel to cells, or empty
  std::vector<CellSources> sources;  // parallel to cells, or empty: there were no camera paths
  // Importance that leaves the scene, as EscapeMap has it: the bins of direction that anything went
  // to, in increasing order, and the luminance of the importons in each position cell of each.
  std::vector<uint32_t> escape_bins;
  std::vector<float> escape_weights;  // EscapeMap::kCells for each bin
  MediumCache medium;                 // without cells where the scene has no media
};

}  // namespace waylight
