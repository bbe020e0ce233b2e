#include "formats/cache_file.h"

#include "formats/cache_records.h"
#include "formats/file_bytes.h"
#include "formats/file_map.h"
#include "formats/medium_part.h"
#include "libguide/cache/training_check.h"

namespace waylight {
namespace {

// Readers of version 1 take everything for radiance; those of version 2 know no media; those of
// version 3 would train photons alone from where camera paths came to.
constexpr uint32_t kFormatVersion = 4, kMediaVersion = 3, kImportanceVersion = 2;
constexpr uint32_t kRadianceVersion = 1;

uint32_t version_of(const GuideCache& cache) {
  if (!cache.sources.empty()) return kFormatVersion;
  if (!cache.medium.cells.empty()) return kMediaVersion;
  return cache.quantity == Quantity::radiance ? kRadianceVersion : kImportanceVersion;
}

size_t bytes_needed(const CacheFile& file) {
  const GuideCache& c = file.cache;
  return provenance_bytes(file.provenance) + c.nodes.size() * sizeof(CacheNode) +
         c.cells.size() * sizeof(CacheCell) + c.reaches.size() * sizeof(CellReach) +
         c.components.size() * sizeof(GaussianComponent) +
         c.statistics.size() * sizeof(ComponentStatistics) +
         c.training.size() * sizeof(CellTraining) + c.sources.size() * sizeof(CellSources) +
         (c.escape_bins.size() + c.escape_weights.size()) * sizeof(float) + medium_bytes(c.medium);
}

// What is wrong with the training part; check() of the view comes first.
std::string check_training_part(const GuideCache& cache) {
  const MediumCache& medium = cache.medium;
  if (cache.statistics.empty() && cache.training.empty() && cache.sources.empty() &&
      medium.statistics.empty() && medium.training.empty())
    return {};
  return check_training(cache);
}

std::string check_all(const GuideCache& cache) {
  const std::string fault = check(GuideCacheView(cache));
  return fault.empty() ? check_training_part(cache) : fault;
}

// Field by field: a copy of the record would bring the undefined bytes of its padding along.
fbs::CellTraining to_flat(const CellTraining& t) {
  return {waylight::to_flat(t.position_mean),
          waylight::to_flat(t.position_m2),
          waylight::to_flat(t.position_cross),
          waylight::to_flat(t.normal_mean),
          waylight::to_flat(t.normal_m2),
          t.count,
          t.flux,
          t.born,
          t.inherited_area,
          t.step,
          t.samples,
          t.weight_sum,
          t.weight_sum2};
}

auto add_training(flatbuffers::FlatBufferBuilder& builder,
                  const std::vector<CellTraining>& training) {
  return builder.CreateVectorOfStructs<fbs::CellTraining>(
      training.size(), [&](size_t i, fbs::CellTraining* flat) { *flat = to_flat(training[i]); });
}

void add_cache(flatbuffers::FlatBufferBuilder& builder, const CacheFile& file) {
  const GuideCache& c = file.cache;
  const bool trainable = !c.training.empty();
  flatbuffers::Offset<flatbuffers::Vector<const fbs::CellTraining*>> training;
  flatbuffers::Offset<flatbuffers::Vector<const fbs::ComponentStatistics*>> statistics;
  if (trainable) training = add_training(builder, c.training);
  if (trainable) statistics = add_records(builder, c.statistics);
  const auto components = add_records(builder, c.components);
  const auto cells = add_records(builder, c.cells);
  const auto nodes = add_records(builder, c.nodes);
  flatbuffers::Offset<flatbuffers::Vector<const fbs::Bounds*>> reaches;
  if (!c.reaches.empty()) reaches = add_records(builder, c.reaches);
  flatbuffers::Offset<flatbuffers::Vector<const fbs::CellSources*>> sources;
  if (!c.sources.empty()) sources = add_records(builder, c.sources);
  flatbuffers::Offset<flatbuffers::Vector<uint32_t>> escape_bins;
  flatbuffers::Offset<flatbuffers::Vector<float>> escape_weights;
  if (!c.escape_bins.empty()) escape_bins = builder.CreateVector(c.escape_bins);
  if (!c.escape_bins.empty()) escape_weights = builder.CreateVector(c.escape_weights);
  const MediumPart medium = add_medium(builder, c.medium);
  const auto provenance = add_provenance(builder, file.provenance);
  const fbs::Bounds bounds = waylight::to_flat(c.scene_bounds);
  fbs::FinishGuideCacheBuffer(
      builder, fbs::CreateGuideCache(
                   builder, version_of(c), provenance, &bounds, c.emitted, c.passes, c.photons,
                   nodes, cells, components, statistics, training, waylight::to_flat(c.quantity),
                   escape_bins, escape_weights, c.medium.emitted, c.medium.photons, medium.nodes,
                   medium.cells, medium.components, medium.statistics, medium.training, c.paths,
                   sources, reaches, true, medium.focused_cells, medium.focused_lobes));
}

const fbs::GuideCache& root_of(const FileMap& map) {
  return verified_root<fbs::GuideCache>(map.bytes(), map.path(), FileKind::cache,
                                        fbs::GuideCacheIdentifier(), kFormatVersion);
}

template <typename Number>
std::span<const Number> numbers_of(const flatbuffers::Vector<Number>* vector) {
  return vector ? std::span(vector->data(), vector->size()) : std::span<const Number>();
}

GuideCacheView view_of(const fbs::GuideCache& root, const std::string& path) {
  GuideCacheView view(from_flat(*root.scene_bounds()), records_of<CacheNode>(root.nodes(), path),
                      records_of<CacheCell>(root.cells(), path),
                      records_of<GaussianComponent>(root.components(), path));
  view.quantity = quantity_from(root.quantity(), path);
  view.reaches = records_of<CellReach>(root.boxes(), path);
  view.escape_bins = numbers_of(root.escape_bins());
  view.escape_weights = numbers_of(root.escape_weights());
  view.medium = medium_view_of(root, path);
  if (const std::string fault = check(view); !fault.empty()) fail_damaged(path, fault);
  return view;
}

GuideCache copy_of(const fbs::GuideCache& root, const std::string& path) {
  const GuideCacheView view = view_of(root, path);
  GuideCache cache;
  cache.quantity = view.quantity;
  cache.scene_bounds = view.scene_bounds;
  cache.reaches = waylight::copy_of(view.reaches);
  cache.escape_bins = waylight::copy_of(view.escape_bins);
  cache.escape_weights = waylight::copy_of(view.escape_weights);
  cache.emitted = root.emitted();
  cache.passes = root.passes();
  cache.photons = root.photons();
  cache.nodes = waylight::copy_of(view.nodes);
  cache.cells = waylight::copy_of(view.cells);
  cache.components = waylight::copy_of(view.components);
  cache.statistics = waylight::copy_of(records_of<ComponentStatistics>(root.statistics(), path));
  cache.training = waylight::copy_of(records_of<CellTraining>(root.training(), path));
  cache.paths = root.paths();
  cache.sources = waylight::copy_of(records_of<CellSources>(root.sources(), path));
  cache.medium = medium_copy_of(root, path);
  return cache;
}

Provenance provenance_of(const fbs::GuideCache& root, const FileMap& map) {
  FlatStrings strings(map.bytes().size(), map.path());
  return provenance_from(*root.provenance(), strings);
}

}  // namespace

void write_cache(const std::string& path, const CacheFile& file) {
  if (const std::string fault = check_all(file.cache); !fault.empty())
    fail("\"{}\": not written, the cache is not valid: {}", path, fault);
  check_flat_size(path, bytes_needed(file), "train fewer --max-cells, or reduce the cache");
  flatbuffers::FlatBufferBuilder builder(bytes_needed(file) + 4096);
  add_cache(builder, file);
  write_sealed(path, builder);
}

CacheFile read_cache(const std::string& path) {
  const FileMap map(path);
  const fbs::GuideCache& root = root_of(map);
  CacheFile file{provenance_of(root, map), copy_of(root, path)};
  if (const std::string fault = check_training_part(file.cache); !fault.empty())
    fail_damaged(path, fault);
  return file;
}

struct MappedCache::Impl {
  explicit Impl(const std::string& path)
      : map(path),
        provenance(provenance_of(root_of(map), map)),
        view(view_of(*fbs::GetGuideCache(map.bytes().data()), path)) {}

  FileMap map;
  Provenance provenance;
  GuideCacheView view;
};

MappedCache::MappedCache(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
MappedCache::~MappedCache() = default;
MappedCache::MappedCache(MappedCache&&) noexcept = default;

const Provenance& MappedCache::provenance() const { return impl_->provenance; }
GuideCacheView MappedCache::view() const { return impl_->view; }

}  // namespace waylight
