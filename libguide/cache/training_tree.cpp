#include "libguide/cache/training_tree.h"

#include <algorithm>
#include <cmath>

#include "libguide/base/parallel.h"
#include "libguide/cache/cell_moments.h"
#include "libguide/cache/guide_cache_view.h"

namespace waylight {
namespace {

// A cell that saw nothing does not know its side: lookups compare normals in any case.
bool same_side(const TrainingCell& borrower, const TrainingCell& lender) {
  const Vec3& normal = lender.cell().normal;
  return borrower.training().count == 0 ||
         mean_normal(borrower.training(), normal).dot(normal) >= kMinNormalCosine;
}

// A long training makes both more cells and better ones: beyond kFineTraining photons the threshold
// grows with their square root. Finer cells would cost more to look up than they save in variance.
double photons_before_split(const TreeOptions& tree, double now) {
  constexpr double kFineTraining = 5e6;
  return static_cast<double>(tree.photons_per_cell) * std::sqrt(std::max(1.0, now / kFineTraining));
}

// A cell that was made when no photons came any more, but samples of camera paths, knows no flux.
CellTraining training_of(const GuideCache& previous, size_t i) {
  CellTraining training = previous.training[i];
  if (training.born >= static_cast<double>(previous.photons)) training.flux = 0;
  return training;
}

std::deque<TrainingCell> cells_of(const GuideCache& previous) {
  std::deque<TrainingCell> cells;
  for (size_t i = 0; i < previous.cells.size(); ++i) {
    const CacheCell& cell = previous.cells[i];
    const CellTraining training = training_of(previous, i);
    cells.emplace_back(
        cell, training,
        std::span(previous.components).subspan(cell.first_component, cell.component_count),
        std::span(previous.statistics).subspan(cell.first_component, cell.component_count),
        previous.reaches.empty() ? CellReach() : previous.reaches[i],
        previous.sources.empty() ? CellEvidence(cell, training)
                                 : CellEvidence(previous.sources[i]));
  }
  return cells;
}

}  // namespace

TrainingTree::TrainingTree(const GuideCache& previous)
    : CellTree(previous.nodes, cells_of(previous)) {}

void TrainingTree::split_full_cells(const TreeOptions& tree, const CellTrainingOptions& options,
                                    double now) {
  const double threshold = photons_before_split(tree, now);
  split_cells(
      tree.max_cells,
      [&](const TrainingCell& cell) {
        return cell.training().count > threshold
                   ? choose_split(cell.training(), tree.normal_spread, tree.min_extent)
                   : std::nullopt;
      },
      [&](const TrainingCell& cell, const CellSplit& split, bool upper) {
        return cell.child(split, upper, now, sqr(tree.min_extent), options);
      });
  if (!options.mixes) return;
  parallel_for(size(), [&](size_t i) {
    (*this)[i].balance_sources(now, sqr(tree.min_extent), options.photons_per_particle);
  });
}

size_t TrainingTree::merge_alike(const CellMergeOptions& options) {
  const size_t before = stored_bytes();
  merge_siblings([&](const TrainingCell& lower, const TrainingCell& upper, const CellSplit& split) {
    return merge_if_alike(lower, upper, split, options);
  });
  return before - std::min(before, stored_bytes());
}

void TrainingTree::lend_mixtures() {
  const auto needs = [](const TrainingCell& cell) { return cell.components().empty(); };
  const auto can_lend = [](const TrainingCell& borrower, const TrainingCell& lender) {
    return !lender.components().empty() && same_side(borrower, lender);
  };
  for (const CellLoan& loan : find_loans(needs, can_lend))
    (*this)[loan.borrower].inherit_mixture((*this)[loan.lender], loan.share);
}

size_t TrainingTree::stored_bytes() const {
  size_t components = 0;
  for (const TrainingCell& cell : cells()) components += cell.components().size();
  return nodes().size() * sizeof(CacheNode) + size() * (sizeof(CacheCell) + sizeof(CellReach)) +
         components * sizeof(GaussianComponent);
}

void TrainingTree::store(GuideCache& cache, const TreeOptions& tree,
                         double photons_per_particle) const {
  cache.nodes = nodes();
  cache.cells.clear();
  cache.reaches.clear();
  cache.training.clear();
  cache.components.clear();
  cache.statistics.clear();
  cache.sources.clear();
  const double now = static_cast<double>(cache.photons);
  for (const TrainingCell& trained : cells()) {
    CacheCell cell = trained.cell();
    cell.irradiance = trained.irradiance(now, sqr(tree.min_extent), photons_per_particle);
    cell.first_component = static_cast<uint32_t>(cache.components.size());
    cache.cells.push_back(cell);
    cache.reaches.push_back(trained.reach());
    cache.training.push_back(trained.training());
    if (cache.paths > 0) cache.sources.push_back(trained.evidence().sums());
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

}  // namespace waylight
