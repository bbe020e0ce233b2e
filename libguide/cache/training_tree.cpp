#include "libguide/cache/training_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libguide/base/parallel.h"
#include "libguide/cache/cell_moments.h"
#include "libguide/cache/guide_cache_view.h"

namespace waylight {

namespace {

// How far a cell looks for a mixture to inherit: ancestors up, and leaves under each.
constexpr int kMaxGenerations = 6;
constexpr size_t kMaxRelatives = 64;

// The root is its own parent.
std::vector<uint32_t> parents_of(std::span<const CacheNode> nodes) {
  std::vector<uint32_t> parents(nodes.size());
  for (uint32_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].axis != kLeafAxis) parents[nodes[i].child] = parents[nodes[i].child + 1] = i;
  return parents;
}

// A cell that saw nothing does not know its side: lookups compare normals in any case.
bool same_side(const TrainingCell& borrower, const TrainingCell& lender) {
  const Vec3& normal = lender.cell().normal;
  return borrower.training().count == 0 ||
         mean_normal(borrower.training(), normal).dot(normal) >= kMinNormalCosine;
}

float distance2(const TrainingCell& a, const TrainingCell& b) {
  return (a.training().position_mean - b.training().position_mean).squaredNorm();
}

}  // namespace

static_assert(kMaxTreeDepth < 256);

double TrainingClock::exposure(double born) const {
  const double stream = photons - photons_before;
  const double before = photons_before > 0 ? std::max(0.0, 1 - born / photons_before) : 1;
  const double during = stream > 0 ? (photons - std::max(born, photons_before)) / stream : 1;
  return before * particles_before + during * (particles - particles_before);
}

TrainingTree::TrainingTree() : nodes_{{0, 0, kLeafAxis}}, cells_(1), node_of_cell_{0}, depth_{0} {}

TrainingTree::TrainingTree(const GuideCache& previous)
    : nodes_(previous.nodes), node_of_cell_(previous.cells.size()), depth_(previous.cells.size()) {
  for (size_t i = 0; i < previous.cells.size(); ++i) {
    const CacheCell& cell = previous.cells[i];
    cells_.emplace_back(
        cell, previous.training[i],
        std::span(previous.components).subspan(cell.first_component, cell.component_count),
        std::span(previous.statistics).subspan(cell.first_component, cell.component_count));
  }
  std::vector<uint8_t> depth(nodes_.size());
  for (uint32_t i = 0; i < nodes_.size(); ++i) {
    const CacheNode& node = nodes_[i];
    if (node.axis == kLeafAxis) {
      node_of_cell_[node.child] = i;
      depth_[node.child] = depth[i];
    } else {
      depth[node.child] = depth[node.child + 1] = static_cast<uint8_t>(depth[i] + 1);
    }
  }
}

// A long training makes both more cells and better ones: beyond kFineTraining photons the threshold
// grows with their square root. Finer cells would cost more to look up than they save in variance.
static double photons_before_split(const TreeOptions& tree, double now) {
  constexpr double kFineTraining = 5e6;
  return static_cast<double>(tree.photons_per_cell) * std::sqrt(std::max(1.0, now / kFineTraining));
}

void TrainingTree::split_full_cells(const TreeOptions& tree, const CellTrainingOptions& options,
                                    double now) {
  const uint32_t count = static_cast<uint32_t>(cells_.size());
  const double threshold = photons_before_split(tree, now);
  for (uint32_t i = 0; i < count && cells_.size() < tree.max_cells; ++i) {
    const CellTraining& training = cells_[i].training();
    if (training.count <= threshold) continue;
    if (depth_[i] >= kMaxTreeDepth) continue;
    const auto where = choose_split(training, tree.normal_spread, tree.min_extent);
    if (where) split(i, *where, tree, options, now);
  }
}

void TrainingTree::split(uint32_t cell, const CellSplit& split, const TreeOptions& tree,
                         const CellTrainingOptions& options, double now) {
  const uint32_t child = static_cast<uint32_t>(nodes_.size());
  const uint32_t new_cell = static_cast<uint32_t>(cells_.size());
  nodes_[node_of_cell_[cell]] = {split.value, child, split.axis};
  nodes_.push_back({0, cell, kLeafAxis});
  nodes_.push_back({0, new_cell, kLeafAxis});
  cells_[cell] = cells_[cell].child(split, now, sqr(tree.min_extent), options);
  cells_.push_back(cells_[cell]);
  node_of_cell_[cell] = child;
  node_of_cell_.push_back(child + 1);
  depth_[cell] += 1;
  depth_.push_back(depth_[cell]);
}

void TrainingTree::restate_exposure(const TrainingClock& clock) {
  if (clock.particles_before <= 0) return;
  for (TrainingCell& cell : cells_) {
    const double share = clock.exposure(cell.training().born) / clock.particles;
    cell.restate_birth(clock.photons * std::clamp(1 - share, 0.0, 1.0));
  }
}

void TrainingTree::lend_mixtures() {
  const std::vector<uint32_t> parents = parents_of(nodes_);
  std::vector<Loan> loans;
  for (uint32_t i = 0; i < cells_.size(); ++i) {
    if (!cells_[i].components().empty()) continue;
    if (const std::optional<Loan> loan = find_loan(i, parents)) loans.push_back(*loan);
  }
  for (const Loan& loan : loans)
    cells_[loan.borrower].inherit_mixture(cells_[loan.lender], loan.share);
}

// Each generation halves the evidence, as the splits in between would have done.
std::optional<TrainingTree::Loan> TrainingTree::find_loan(uint32_t borrower,
                                                          std::span<const uint32_t> parents) const {
  uint32_t node = node_of_cell_[borrower];
  float share = 1;
  for (int i = 0; i < kMaxGenerations && node != 0; ++i) {
    node = parents[node];
    share *= 0.5f;
    if (const std::optional<uint32_t> lender = nearest_lender(cells_[borrower], node))
      return Loan{borrower, *lender, share};
  }
  return std::nullopt;
}

std::optional<uint32_t> TrainingTree::nearest_lender(const TrainingCell& borrower,
                                                     uint32_t subtree) const {
  std::optional<uint32_t> nearest;
  std::vector<uint32_t> open = {subtree};
  for (size_t leaves = 0; !open.empty() && leaves < kMaxRelatives;) {
    const CacheNode& node = nodes_[open.back()];
    open.pop_back();
    if (node.axis != kLeafAxis) {
      open.insert(open.end(), {node.child + 1, node.child});
      continue;
    }
    ++leaves;
    const TrainingCell& lender = cells_[node.child];
    if (lender.components().empty() || !same_side(borrower, lender)) continue;
    if (!nearest || distance2(borrower, lender) < distance2(borrower, cells_[*nearest]))
      nearest = node.child;
  }
  return nearest;
}

void TrainingTree::store(GuideCache& cache, const TreeOptions& tree,
                         double irradiance_scale) const {
  cache.nodes = nodes_;
  cache.cells.clear();
  cache.training.clear();
  cache.components.clear();
  cache.statistics.clear();
  const double now = static_cast<double>(cache.photons);
  for (const TrainingCell& trained : cells_) {
    CacheCell cell = trained.cell();
    cell.irradiance =
        static_cast<float>(trained.irradiance(now, sqr(tree.min_extent)) * irradiance_scale);
    cell.first_component = static_cast<uint32_t>(cache.components.size());
    cache.cells.push_back(cell);
    cache.training.push_back(trained.training());
    cache.components.insert(cache.components.end(), trained.components().begin(),
                            trained.components().end());
    cache.statistics.insert(cache.statistics.end(), trained.statistics().begin(),
                            trained.statistics().end());
  }
  parallel_for(cache.cells.size(), [&](size_t i) {
    CacheCell& cell = cache.cells[i];
    const GaussianMixture mixture(
        std::span(cache.components).subspan(cell.first_component, cell.component_count));
    cell.guided_mass = cell.component_count > 0 ? mass_inside(mixture) : 0.0f;
  });
}

size_t TrainingTree::bytes() const {
  return nodes_.capacity() * sizeof(CacheNode) +
         cells_.size() * (sizeof(TrainingCell) + sizeof(uint32_t) + sizeof(uint8_t));
}

}  // namespace waylight
