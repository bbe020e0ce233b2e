#pragma once
// The cells of a cache in training and the tree over them.

#include <deque>
#include <optional>
#include <vector>

#include "libguide/cache/training_cell.h"

namespace waylight {

// When cells are split, and how the scene's size enters.
struct TreeOptions {
  size_t photons_per_cell = 4000, max_cells = 200'000;
  float normal_spread = 0.9f;
  float min_extent = 0;  // standard deviation below which positions are one place
};

// Photons and particles of the training so far, and of those what came before the current stream.
struct TrainingClock {
  double photons = 0, particles = 0;
  double photons_before = 0, particles_before = 0;

  // Particles since a cell was made, `born` in photons: streams differ in photons per particle.
  double exposure(double born) const;
};

class TrainingTree {
 public:
  TrainingTree();  // one cell
  // previous: has training statistics and passed check() and check_training().
  explicit TrainingTree(const GuideCache& previous);

  uint32_t find(const Photon& photon) const {
    return find_leaf(nodes_, photon.position, photon.normal);
  }
  size_t size() const { return cells_.size(); }
  TrainingCell& operator[](size_t i) { return cells_[i]; }

  // Splits the cells that saw more than their photons, in index order: the result does not depend
  // on threads. now: photons of the whole training so far.
  void split_full_cells(const TreeOptions& tree, const CellTrainingOptions& options, double now);

  // Restates when cells were made so that the photons since then stand for their particles at the
  // mean rate of the whole training; for a first stream they do.
  void restate_exposure(const TrainingClock& clock);

  // Cells without a mixture inherit that of a relative nearby whose surface faces the same way.
  void lend_mixtures();

  // irradiance_scale: photons per emitted particle, 1/J to W of TrainingCell::irradiance.
  void store(GuideCache& cache, const TreeOptions& tree, double irradiance_scale) const;

  size_t bytes() const;

 private:
  struct Loan {
    uint32_t borrower = 0, lender = 0;
    float share = 1;  // of the lender's evidence
  };
  std::optional<Loan> find_loan(uint32_t borrower, std::span<const uint32_t> parents) const;
  std::optional<uint32_t> nearest_lender(const TrainingCell& borrower, uint32_t subtree) const;
  void split(uint32_t cell, const CellSplit& split, const TreeOptions& tree,
             const CellTrainingOptions& options, double now);

  std::vector<CacheNode> nodes_;
  std::deque<TrainingCell> cells_;  // never moved: growing a vector would need twice the memory
  std::vector<uint32_t> node_of_cell_;
  std::vector<uint8_t> depth_;  // of the cell's leaf
};

}  // namespace waylight
