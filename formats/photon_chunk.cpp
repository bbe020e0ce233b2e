#include "formats/photon_chunk.h"

#include "formats/flat_records.h"
#include "formats/octahedral.h"

namespace waylight {
namespace {

// Readers of version 1 take everything for radiance, and know no escapes; those of version 2 know
// no media, and those of version 3 no camera paths.
constexpr uint32_t kFormatVersion = 4, kMediaVersion = 3, kImportanceVersion = 2;
constexpr uint32_t kRadianceVersion = 1;

static_assert(sizeof(fbs::Photon) == 36 && sizeof(fbs::Escape) == 32);
static_assert(sizeof(fbs::MediumPhoton) == 32);

uint32_t version_of(const PhotonStreamInfo& stream) {
  if (stream.paths > 0) return kFormatVersion;
  if (stream.media) return kMediaVersion;
  return stream.quantity == Quantity::radiance ? kRadianceVersion : kImportanceVersion;
}

// A NaN fails every comparison.
bool sensible(const Vec3& position, const Color& power) {
  constexpr float kMax = std::numeric_limits<float>::max();
  return (position.array().abs() <= kMax).all() && (power >= 0).all() && (power <= kMax).all();
}

bool sensible(const Photon& p) { return sensible(p.position, p.power); }
bool sensible(const Escape& e) { return sensible(e.origin, e.power); }
bool sensible(const MediumPhoton& p) { return sensible(p.position, p.weight); }

bool is_unit(const Vec3& w) { return std::abs(w.squaredNorm() - 1) < 1e-3f; }

void finish(flatbuffers::FlatBufferBuilder& builder, fbs::ChunkContent kind,
            flatbuffers::Offset<void> content) {
  fbs::FinishSizePrefixedPhotonChunkBuffer(builder, fbs::CreatePhotonChunk(builder, kind, content));
}

Photon unpack(const fbs::Photon& flat) {
  Photon photon;
  photon.position = from_flat(flat.position());
  photon.direction = from_octahedral({flat.direction_u(), flat.direction_v()});
  photon.normal = from_octahedral({flat.normal_u(), flat.normal_v()});
  photon.power = from_flat(flat.power()).array();
  photon.path_depth = flat.path_depth();
  return photon;
}

Escape unpack(const fbs::Escape& flat) {
  return {from_flat(flat.origin()), from_octahedral({flat.direction_u(), flat.direction_v()}),
          from_flat(flat.power()).array(), flat.path_depth()};
}

MediumPhoton unpack(const fbs::MediumPhoton& flat) {
  return {from_flat(flat.position()), from_octahedral({flat.direction_u(), flat.direction_v()}),
          from_flat(flat.weight()).array(), flat.path_depth()};
}

// All records of a block; `what` names one.
template <typename Record, typename Flat>
void unpack_all(const flatbuffers::Vector<const Flat*>* packed, const std::string& path,
                const char* what, std::vector<Record>* records) {
  records->resize(packed ? packed->size() : 0);
  for (uint32_t i = 0; i < records->size(); ++i) {
    Record& record = (*records)[i];
    record = unpack(*packed->Get(i));
    if (!sensible(record))
      fail_damaged(path, fmt::format("{} is not finite or of negative power", what));
  }
}

}  // namespace

fbs::MediumPhoton pack(const MediumPhoton& p, const std::string& path) {
  if (!sensible(p) || !is_unit(p.direction))
    fail("\"{}\": a photon in a medium is not finite, of negative weight or without unit direction",
         path);
  const Octahedral direction = to_octahedral(p.direction);
  return {to_flat(p.position), to_flat(p.weight), direction.u, direction.v, p.path_depth};
}

fbs::Escape pack(const Escape& e, const std::string& path) {
  if (!sensible(e) || !is_unit(e.direction))
    fail("\"{}\": an escape is not finite, of negative power or without unit direction", path);
  const Octahedral direction = to_octahedral(e.direction);
  return {to_flat(e.origin), to_flat(e.power), direction.u, direction.v, e.path_depth};
}

fbs::Photon pack(const Photon& p, const std::string& path) {
  if (!sensible(p) || !is_unit(p.direction) || !is_unit(p.normal))
    fail("\"{}\": a photon is not finite, of negative power or without unit directions", path);
  const Octahedral direction = to_octahedral(p.direction), normal = to_octahedral(p.normal);
  return {to_flat(p.position), to_flat(p.power), direction.u, direction.v, normal.u, normal.v,
          p.path_depth};
}

void build_header(flatbuffers::FlatBufferBuilder& builder, const PhotonHeader& header,
                  const std::string& path) {
  if (provenance_bytes(header.provenance) > kMaxChunkBytes / 2)
    fail("\"{}\": the command line and the parents' names are too long for its header", path);
  builder.Clear();
  const auto provenance = add_provenance(builder, header.provenance);
  const PhotonStreamInfo& stream = header.stream;
  const fbs::Bounds bounds = to_flat(stream.scene_bounds);
  const auto flat = fbs::CreatePhotonHeader(builder, version_of(stream), provenance,
                                            stream.scene_bounds.empty() ? nullptr : &bounds,
                                            stream.emitted, stream.pass, to_flat(stream.quantity),
                                            stream.media, stream.paths, stream.expected);
  finish(builder, fbs::ChunkContent::PhotonHeader, flat.Union());
}

void build_block(flatbuffers::FlatBufferBuilder& builder, std::span<const fbs::Photon> photons) {
  builder.Clear();
  const auto vector = builder.CreateVectorOfStructs(photons.data(), photons.size());
  finish(builder, fbs::ChunkContent::PhotonBlock, fbs::CreatePhotonBlock(builder, vector).Union());
}

void build_block(flatbuffers::FlatBufferBuilder& builder, std::span<const fbs::Escape> escapes) {
  builder.Clear();
  const auto vector = builder.CreateVectorOfStructs(escapes.data(), escapes.size());
  finish(builder, fbs::ChunkContent::EscapeBlock, fbs::CreateEscapeBlock(builder, vector).Union());
}

void build_block(flatbuffers::FlatBufferBuilder& builder,
                 std::span<const fbs::MediumPhoton> photons) {
  builder.Clear();
  const auto vector = builder.CreateVectorOfStructs(photons.data(), photons.size());
  finish(builder, fbs::ChunkContent::MediumBlock, fbs::CreateMediumBlock(builder, vector).Union());
}

void build_sample_block(flatbuffers::FlatBufferBuilder& builder,
                        std::span<const fbs::Photon> samples) {
  builder.Clear();
  const auto vector = builder.CreateVectorOfStructs(samples.data(), samples.size());
  finish(builder, fbs::ChunkContent::SampleBlock, fbs::CreateSampleBlock(builder, vector).Union());
}

void build_end(flatbuffers::FlatBufferBuilder& builder, const PhotonCounts& c, uint64_t hash) {
  builder.Clear();
  const auto end =
      fbs::CreatePhotonEnd(builder, c.emitted, c.stored, c.left_scene, c.absorbed, c.too_deep,
                           c.invalid, c.escapes, c.in_media, c.paths, c.samples, hash);
  finish(builder, fbs::ChunkContent::PhotonEnd, end.Union());
}

const fbs::PhotonChunk& verified_chunk(std::string_view bytes, const std::string& path) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  flatbuffers::Verifier verifier(data, bytes.size());
  if (!fbs::VerifySizePrefixedPhotonChunkBuffer(verifier))
    fail_damaged(path, "bytes of a chunk were changed");
  const fbs::PhotonChunk& chunk = *fbs::GetSizePrefixedPhotonChunk(data);
  if (!chunk.content()) fail_damaged(path, "an empty chunk");
  return chunk;
}

PhotonHeader header_of(const fbs::PhotonHeader& flat, size_t chunk_bytes, const std::string& path) {
  check_format_version(path, flat.format_version(), kFormatVersion);
  FlatStrings strings(chunk_bytes, path);
  PhotonHeader header;
  header.provenance = provenance_from(*flat.provenance(), strings);
  if (flat.scene_bounds()) {
    Bounds& bounds = header.stream.scene_bounds;
    bounds = from_flat(*flat.scene_bounds());
    if (bounds.empty() || !bounds.min.allFinite() || !bounds.max.allFinite())
      fail_damaged(path, "scene bounds that are empty or not finite");
  }
  header.stream.emitted = flat.emitted();
  header.stream.pass = flat.pass();
  header.stream.quantity = quantity_from(flat.quantity(), path);
  header.stream.media = flat.media();
  header.stream.paths = flat.paths();
  header.stream.expected = flat.expected();
  if (header.stream.paths > 0 && header.stream.quantity != Quantity::radiance)
    fail_damaged(path, "camera paths in a stream of importance");
  return header;
}

void photons_of(const fbs::PhotonBlock& flat, const std::string& path,
                std::vector<Photon>* photons) {
  unpack_all(flat.photons(), path, "a photon", photons);
}

void samples_of(const fbs::SampleBlock& flat, const std::string& path,
                std::vector<Photon>* samples) {
  unpack_all(flat.samples(), path, "a sample of a camera path", samples);
  for (Photon& sample : *samples) sample.from = TracedFrom::camera;
}

void escapes_of(const fbs::EscapeBlock& flat, const std::string& path,
                std::vector<Escape>* escapes) {
  unpack_all(flat.escapes(), path, "an escape", escapes);
}

void medium_photons_of(const fbs::MediumBlock& flat, const std::string& path,
                       std::vector<MediumPhoton>* photons) {
  unpack_all(flat.photons(), path, "a photon in a medium", photons);
}

PhotonCounts counts_of(const fbs::PhotonEnd& flat) {
  PhotonCounts counts;
  counts.emitted = flat.emitted();
  counts.stored = flat.stored();
  counts.left_scene = flat.left_scene();
  counts.absorbed = flat.absorbed();
  counts.too_deep = flat.too_deep();
  counts.invalid = flat.invalid();
  counts.escapes = flat.escapes();
  counts.in_media = flat.in_media();
  counts.paths = flat.paths();
  counts.samples = flat.samples();
  return counts;
}

}  // namespace waylight
