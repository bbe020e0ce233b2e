#include "formats/flat_file.h"

#include "formats/byte_stream.h"

namespace waylight {
namespace {

constexpr size_t kMaxFlatBytes = (size_t{1} << 31) - 1;
constexpr size_t kTableBytes = 64;  // more than a small table needs with its vtable

}  // namespace

void check_flat_size(const std::string& path, size_t bulk_bytes, const char* remedy) {
  constexpr size_t kAround = 1 << 16;  // root table, lengths and padding
  if (bulk_bytes > kMaxFlatBytes - kAround)
    fail("\"{}\": {:.1f} GiB do not fit into one file of 2 GiB: {}", path,
         static_cast<double>(bulk_bytes) / (1 << 30), remedy);
}

void check_flat_kind(const std::string& path, std::string_view bytes, FileKind kind) {
  if (bytes.empty()) fail("\"{}\": is empty", path);
  const FileKind found = identify_bytes(bytes.substr(0, kFileHeadBytes));
  if (found != kind) fail("\"{}\": is {}, not {}", path, describe(found), describe(kind));
  if (bytes.size() >= kMaxFlatBytes) fail_damaged(path, "larger than 2 GiB");
}

void check_format_version(const std::string& path, uint32_t version, uint32_t newest) {
  if (version > newest)
    fail("\"{}\": has format version {}, and this release reads up to {}: use a newer release",
         path, version, newest);
  if (version == 0) fail_damaged(path, "no format version");
}

std::string seal_of(std::string_view buffer) {
  ContentHash hash;
  hash.add(buffer);
  const uint64_t value = hash.value();
  std::string seal(kSealMark);
  seal.append(reinterpret_cast<const char*>(&value), sizeof(value));
  return seal;
}

void check_seal(const std::string& path, std::string_view bytes, bool sealed) {
  constexpr size_t kSealBytes = kSealMark.size() + sizeof(uint64_t);
  const size_t buffer = bytes.size() - std::min(bytes.size(), kSealBytes);
  const std::string_view seal = bytes.substr(buffer);
  if (!sealed && !seal.starts_with(kSealMark)) return;
  if (seal != seal_of(bytes.substr(0, buffer)))
    fail_damaged(path, "its checksum is not that of its bytes");
}

void write_sealed(const std::string& path, const flatbuffers::FlatBufferBuilder& builder) {
  ByteSink sink(path);
  sink.write(bytes_of(builder));
  sink.write(seal_of(bytes_of(builder)));
  sink.commit();
}

void fail_damaged(const std::string& path, std::string_view what) {
  fail("\"{}\": is damaged ({}): make it again", path, what);
}

std::string FlatStrings::operator()(const flatbuffers::String* text) {
  if (!text) return {};
  if (text->size() > left_) fail_damaged(path_, "more text than bytes");
  left_ -= text->size();
  return text->str();
}

flatbuffers::Offset<fbs::Provenance> add_provenance(flatbuffers::FlatBufferBuilder& builder,
                                                    const Provenance& p) {
  std::vector<flatbuffers::Offset<fbs::ParentFile>> parents;
  for (const ParentFile& parent : p.parents)
    parents.push_back(
        fbs::CreateParentFile(builder, builder.CreateString(parent.name), parent.hash));
  const auto tool = builder.CreateString(p.tool);
  const auto version = builder.CreateString(p.version);
  const auto command_line = builder.CreateString(p.command_line);
  const auto scene_name = builder.CreateString(p.scene_name);
  const fbs::SceneHash scene(p.scene.geometry, p.scene.materials, p.scene.emitters, p.scene.media);
  return fbs::CreateProvenance(builder, tool, version, command_line, p.seed, scene_name, &scene,
                               builder.CreateVector(parents));
}

Provenance provenance_from(const fbs::Provenance& flat, FlatStrings& strings) {
  Provenance p;
  p.tool = strings(flat.tool());
  p.version = strings(flat.version());
  p.command_line = strings(flat.command_line());
  p.seed = flat.seed();
  p.scene_name = strings(flat.scene_name());
  if (const fbs::SceneHash* scene = flat.scene())
    p.scene = {scene->geometry(), scene->materials(), scene->emitters(), scene->media()};
  if (flat.parents())
    for (const fbs::ParentFile* parent : *flat.parents())
      p.parents.push_back({strings(parent->name()), parent->hash()});
  return p;
}

size_t provenance_bytes(const Provenance& p) {
  size_t bytes = 4 * kTableBytes + p.tool.size() + p.version.size() + p.command_line.size() +
                 p.scene_name.size();
  for (const ParentFile& parent : p.parents) bytes += kTableBytes + parent.name.size();
  return bytes;
}

std::string_view bytes_of(const flatbuffers::FlatBufferBuilder& builder) {
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

}  // namespace waylight
