#include "formats/medium_part.h"

namespace waylight {
namespace {

fbs::MediumLightTraining to_flat(const MediumLightTraining& t) {
  return {t.flux, t.step, t.samples, t.weight_sum, t.weight_sum2};
}

// Field by field: a copy of the record would bring the undefined bytes of its padding along.
fbs::MediumTraining to_flat(const MediumTraining& t) {
  return {waylight::to_flat(t.position_mean),
          waylight::to_flat(t.position_m2),
          waylight::to_flat(t.position_cross),
          t.count,
          t.born,
          t.occupied,
          t.inherited_volume,
          to_flat(t.indirect),
          to_flat(t.direct)};
}

}  // namespace

size_t medium_bytes(const MediumCache& medium) {
  return medium.nodes.size() * sizeof(CacheNode) + medium.cells.size() * sizeof(MediumCell) +
         medium.components.size() * sizeof(VmfComponent) +
         medium.statistics.size() * sizeof(VmfStatistics) +
         medium.training.size() * sizeof(MediumTraining) +
         medium.focused_cells.size() * sizeof(FocusedCell) +
         medium.focused_lobes.size() * sizeof(FocusedLobe);
}

MediumPart add_medium(flatbuffers::FlatBufferBuilder& builder, const MediumCache& medium) {
  MediumPart part;
  if (medium.cells.empty()) return part;
  if (!medium.training.empty()) {
    part.training = builder.CreateVectorOfStructs<fbs::MediumTraining>(
        medium.training.size(),
        [&](size_t i, fbs::MediumTraining* flat) { *flat = to_flat(medium.training[i]); });
    part.statistics = add_records(builder, medium.statistics);
  }
  if (!medium.focused_cells.empty()) {
    part.focused_lobes = add_records(builder, medium.focused_lobes);
    part.focused_cells = add_records(builder, medium.focused_cells);
  }
  part.components = add_records(builder, medium.components);
  part.cells = add_records(builder, medium.cells);
  part.nodes = add_records(builder, medium.nodes);
  return part;
}

MediumCacheView medium_view_of(const fbs::GuideCache& root, const std::string& path) {
  MediumCacheView view;
  view.nodes = records_of<CacheNode>(root.medium_nodes(), path);
  view.cells = records_of<MediumCell>(root.medium_cells(), path);
  view.components = records_of<VmfComponent>(root.medium_components(), path);
  view.focused_cells = records_of<FocusedCell>(root.medium_focused_cells(), path);
  view.focused_lobes = records_of<FocusedLobe>(root.medium_focused_lobes(), path);
  return view;
}

MediumCache medium_copy_of(const fbs::GuideCache& root, const std::string& path) {
  const MediumCacheView view = medium_view_of(root, path);
  MediumCache medium;
  medium.emitted = root.medium_emitted();
  medium.photons = root.medium_photons();
  medium.nodes = copy_of(view.nodes);
  medium.cells = copy_of(view.cells);
  medium.components = copy_of(view.components);
  medium.focused_cells = copy_of(view.focused_cells);
  medium.focused_lobes = copy_of(view.focused_lobes);
  medium.statistics = copy_of(records_of<VmfStatistics>(root.medium_statistics(), path));
  medium.training = copy_of(records_of<MediumTraining>(root.medium_training(), path));
  return medium;
}

}  // namespace waylight
