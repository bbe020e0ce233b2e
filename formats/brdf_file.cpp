#include "formats/brdf_file.h"

#include "formats/brdf_check.h"
#include "formats/brdf_generated.h"
#include "formats/file_bytes.h"
#include "formats/file_map.h"
#include "formats/flat_file.h"
#include "formats/flat_records.h"

namespace waylight {

FLAT_RECORD(BrdfCacheEntry, fbs::BrdfCacheEntry);

namespace {

constexpr uint32_t kFormatVersion = 1;
constexpr size_t kMaxMaterials = 500'000;  // each is a table; the verifier stops at a million

size_t bytes_needed(const BrdfFile& file) {
  size_t bytes = provenance_bytes(file.provenance) +
                 file.cache.entries.size() * sizeof(BrdfCacheEntry) +
                 file.cache.components.size() * sizeof(GaussianComponent);
  for (const MaterialFit& fit : file.cache.materials)
    bytes += 128 + fit.name.size() + fit.kind.size();
  return bytes;
}

void check_writable_content(const std::string& path, const BrdfFile& file) {
  if (const std::string fault = check(file.cache); !fault.empty())
    fail("\"{}\": not written, the fits are not valid: {}", path, fault);
  if (file.cache.materials.size() > kMaxMaterials)
    fail("\"{}\": {} materials are more than {}", path, file.cache.materials.size(), kMaxMaterials);
  check_flat_size(path, bytes_needed(file), "fit fewer --elevations");
}

auto add_materials(flatbuffers::FlatBufferBuilder& builder, const std::vector<MaterialFit>& fits) {
  std::vector<flatbuffers::Offset<fbs::MaterialFit>> tables;
  for (const MaterialFit& fit : fits) {
    const auto name = builder.CreateString(fit.name);
    const auto kind = builder.CreateString(fit.kind);
    tables.push_back(fbs::CreateMaterialFit(builder, fit.material, name, kind, fit.textured,
                                            fit.first_entry, fit.entry_count));
  }
  return builder.CreateVector(tables);
}

std::vector<MaterialFit> materials_of(const fbs::BrdfCache& root, FlatStrings& strings) {
  std::vector<MaterialFit> fits;
  if (!root.materials()) return fits;
  for (const fbs::MaterialFit* m : *root.materials())
    fits.push_back({m->material(), strings(m->name()), strings(m->kind()), m->textured(),
                    m->first_entry(), m->entry_count()});
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
  fbs::FinishBrdfCacheBuffer(builder, fbs::CreateBrdfCache(builder, kFormatVersion, provenance,
                                                           materials, entries, components));
  write_whole_file(path, bytes_of(builder));
}

BrdfFile read_brdf(const std::string& path) {
  const FileMap map(path);
  const auto& root = verified_root<fbs::BrdfCache>(map.bytes(), path, FileKind::brdf,
                                                   fbs::BrdfCacheIdentifier(), kFormatVersion);
  FlatStrings strings(map.bytes().size(), path);
  BrdfFile file;
  file.provenance = provenance_from(*root.provenance(), strings);
  file.cache.materials = materials_of(root, strings);
  file.cache.entries = copy_of(records_of<BrdfCacheEntry>(root.entries(), path));
  file.cache.components = copy_of(records_of<GaussianComponent>(root.components(), path));
  if (const std::string fault = check(file.cache); !fault.empty()) fail_damaged(path, fault);
  return file;
}

}  // namespace waylight
