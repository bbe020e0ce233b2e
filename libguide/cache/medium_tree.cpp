#include "libguide/cache/medium_tree.h"

#include "libguide/cache/medium_cell_merge.h"
#include "libguide/math/saturate.h"

namespace waylight {
namespace {

// The boxes of the cells of a tree within that of the scene.
std::vector<Bounds> boxes_of(const MediumCache& cache, const Bounds& scene) {
  std::vector<Bounds> boxes(cache.nodes.size(), scene), result(cache.cells.size());
  for (size_t i = 0; i < cache.nodes.size(); ++i) {
    const CacheNode& node = cache.nodes[i];
    if (node.axis == kLeafAxis) {
      result[node.child] = boxes[i];
      continue;
    }
    boxes[node.child] = boxes[node.child + 1] = boxes[i];
    boxes[node.child].max[node.axis] = node.split;
    boxes[node.child + 1].min[node.axis] = node.split;
  }
  return result;
}

std::deque<MediumTrainingCell> cells_of(const MediumCache& cache, const Bounds& scene) {
  const std::vector<Bounds> boxes = boxes_of(cache, scene);
  const auto lobes = [&](const MediumLight& light) {
    return TrainedLobes{
        std::span(cache.components).subspan(light.first_component, light.component_count),
        std::span(cache.statistics).subspan(light.first_component, light.component_count)};
  };
  std::deque<MediumTrainingCell> cells;
  for (size_t i = 0; i < cache.cells.size(); ++i)
    cells.emplace_back(boxes[i], cache.cells[i], cache.training[i], lobes(cache.cells[i].indirect),
                       lobes(cache.cells[i].direct));
  for (const FocusedCell& f : cache.focused_cells)
    cells[f.cell].indirect().set_focused(
        std::span(cache.focused_lobes).subspan(f.first_lobe, f.lobe_count));
  return cells;
}

void append(const TrainingLight& light, MediumCache& cache) {
  cache.components.insert(cache.components.end(), light.components().begin(),
                          light.components().end());
  cache.statistics.insert(cache.statistics.end(), light.statistics().begin(),
                          light.statistics().end());
}

void append_focused(const TrainingLight& light, MediumCache& cache) {
  if (light.focused().empty()) return;
  cache.focused_cells.push_back({static_cast<uint32_t>(cache.cells.size() - 1),
                                 static_cast<uint32_t>(cache.focused_lobes.size()),
                                 static_cast<uint32_t>(light.focused().size())});
  cache.focused_lobes.insert(cache.focused_lobes.end(), light.focused().begin(),
                             light.focused().end());
}

using LightOf = TrainingLight& (MediumTrainingCell::*)();
using ConstLightOf = const TrainingLight& (MediumTrainingCell::*)() const;

void lend(MediumTree& tree, LightOf light, ConstLightOf known) {
  const auto knows = [known](const MediumTrainingCell& cell) {
    return !(cell.*known)().components().empty();
  };
  const auto needs = [&](const MediumTrainingCell& cell) { return !knows(cell); };
  const auto can_lend = [&](const MediumTrainingCell&, const MediumTrainingCell& lender) {
    return knows(lender);
  };
  for (const CellLoan& loan : tree.find_loans(needs, can_lend))
    (tree[loan.borrower].*light)().inherit((tree[loan.lender].*light)(), loan.share);
}

}  // namespace

MediumTree::MediumTree(const MediumCache& previous, const Bounds& scene)
    : CellTree(previous.nodes, cells_of(previous, scene)) {}

void MediumTree::split_full_cells(const MediumTreeOptions& tree, const MediumCellOptions& options,
                                  double now) {
  split_cells(
      tree.max_cells,
      [&](const MediumTrainingCell& cell) {
        return cell.choose_split(tree.photons_per_cell, options.min_extent);
      },
      [&](const MediumTrainingCell& cell, const CellSplit& split, bool upper) {
        return cell.child(split, upper, now, options);
      });
}

void MediumTree::merge_alike(const MediumCellOptions& options, double now) {
  merge_siblings([&](const MediumTrainingCell& lower, const MediumTrainingCell& upper,
                     const CellSplit&) { return merge_if_alike(lower, upper, options, now); });
}

void MediumTree::lend_mixtures() {
  lend(*this, &MediumTrainingCell::indirect, &MediumTrainingCell::indirect);
  lend(*this, &MediumTrainingCell::direct, &MediumTrainingCell::direct);
}

void MediumTree::store(MediumCache& cache, const MediumCellOptions& options,
                       double fluence_scale) const {
  cache.nodes = nodes();
  const double now = static_cast<double>(cache.photons);
  const auto store_light = [&](const MediumTrainingCell& cell, const TrainingLight& light) {
    MediumLight record = light.record();
    record.fluence = saturated(cell.fluence(light, now, options.min_extent) * fluence_scale);
    record.first_component = static_cast<uint32_t>(cache.components.size());
    append(light, cache);
    return record;
  };
  for (const MediumTrainingCell& trained : cells()) {
    MediumCell& cell = cache.cells.emplace_back();
    cell.indirect = store_light(trained, trained.indirect());
    cell.direct = store_light(trained, trained.direct());
    cache.training.push_back(trained.training());
    append_focused(trained.indirect(), cache);
  }
}

}  // namespace waylight
