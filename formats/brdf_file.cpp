#include "formats/brdf_file.h"

#include <fmt/format.h>

#include "formats/brdf_check.h"
#include "formats/brdf_generated.h"
#include "formats/file_bytes.h"
#include "formats/file_map.h"
#include "formats/flat_file.h"
#include "formats/flat_records.h"

namespace waylight {

FLAT_RECORD(BrdfCacheEntry, fbs::BrdfCacheEntry);
FLAT_RECORD(WidthSeries, fbs::WidthSeries);

namespace {

// 2: some material has another layout than elevations. A file says the least version that it needs.
constexpr uint32_t kFormatVersion = 2;
constexpr size_t kMaxMaterials = 500'000;  // each is a table; the verifier stops at a million

uint32_t version_needed(const BrdfCache& cache) {
  for (const MaterialFit& fit : cache.materials)
    if (fit.layout != EntryLayout::elevations) return 2;
  return 1;
}

size_t bytes_needed(const BrdfFile& file) {
  size_t bytes = provenance_bytes(file.provenance) +
                 file.cache.entries.size() * sizeof(BrdfCacheEntry) +
                 file.cache.components.size() * sizeof(GaussianComponent);
  for (const MaterialFit& fit : file.cache.materials)
    bytes += 192 + fit.name.size() + fit.kind.size() + fit.widths.size() * sizeof(WidthSeries);
  return bytes;
}

void check_writable_content(const std::string& path, const BrdfFile& file) {
  if (const std::string fault = check(file.cache); !fault.empty())
    fail("\"{}\": not written, the fits are not valid: {}", path, fault);
  if (file.cache.materials.size() > kMaxMaterials)
    fail("\"{}\": {} materials are more than {}", path, file.cache.materials.size(), kMaxMaterials);
  check_flat_size(path, bytes_needed(file), "allow fewer --elevations or --directions");
}

auto add_materials(flatbuffers::FlatBufferBuilder& builder, const std::vector<MaterialFit>& fits) {
  std::vector<flatbuffers::Offset<fbs::MaterialFit>> tables;
  for (const MaterialFit& fit : fits) {
    const auto name = builder.CreateString(fit.name);
    const auto kind = builder.CreateString(fit.kind);
    const auto widths = fit.widths.empty() ? 0 : add_records(builder, fit.widths);
    tables.push_back(fbs::CreateMaterialFit(builder, fit.material, name, kind, fit.textured,
                                            fit.first_entry, fit.entry_count,
                                            static_cast<fbs::EntryLayout>(fit.layout), widths));
  }
  return builder.CreateVector(tables);
}

std::vector<MaterialFit> materials_of(const fbs::BrdfCache& root, FlatStrings& strings,
                                      const std::string& path) {
  std::vector<MaterialFit> fits;
  if (!root.materials()) return fits;
  // Tables may be shared, and widths are copied for each that names them.
  size_t widths = 0;
  const size_t most = root.entries() ? root.entries()->size() : 0;
  for (const fbs::MaterialFit* m : *root.materials()) {
    if (m->widths() && (widths += m->widths()->size()) > most)
      fail_damaged(path, fmt::format("materials have more widths than there are {} entries", most));
    fits.push_back({m->material(), strings(m->name()), strings(m->kind()), m->textured(),
                    m->first_entry(), m->entry_count(), static_cast<EntryLayout>(m->layout()),
                    copy_of(records_of<WidthSeries>(m->widths(), path))});
  }
  return fits;
}

}  // namespace

void write_brdf(const std::string& path, const BrdfFile& file) {
  check_writable_content(path, file);
  flatbuffers::FlatBufferBuilder builder(bytes_needed(file) + 4096);
  const auto components = add_records(builder, file.cache.components);
  const auto entries = add_records(builder, file.cache.entries);
  const auto materials = add_materials(builder, file.cache.materials);
  const auto provenance = add_provenance(builder, file.provenance);
  fbs::FinishBrdfCacheBuffer(
      builder, fbs::CreateBrdfCache(builder, version_needed(file.cache), provenance, materials,
                                    entries, components, true));
  write_sealed(path, builder);
}

BrdfFile read_brdf(const std::string& path) {
  const FileMap map(path);
  const auto& root = verified_root<fbs::BrdfCache>(map.bytes(), path, FileKind::brdf,
                                                   fbs::BrdfCacheIdentifier(), kFormatVersion);
  FlatStrings strings(map.bytes().size(), path);
  BrdfFile file;
  file.provenance = provenance_from(*root.provenance(), strings);
  file.cache.materials = materials_of(root, strings, path);
  file.cache.entries = copy_of(records_of<BrdfCacheEntry>(root.entries(), path));
  file.cache.components = copy_of(records_of<GaussianComponent>(root.components(), path));
  if (const std::string fault = check(file.cache); !fault.empty()) fail_damaged(path, fault);
  return file;
}

}  // namespace waylight
