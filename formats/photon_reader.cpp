#include <algorithm>

#include "formats/byte_stream.h"
#include "formats/photon_chunk.h"
#include "formats/photon_file.h"

namespace waylight {
namespace {

constexpr size_t kPrefixBytes = sizeof(uint32_t);

uint32_t chunk_bytes(const std::vector<char>& prefix) {
  return flatbuffers::ReadScalar<uint32_t>(prefix.data());
}

}  // namespace

struct PhotonReader::Impl {
  explicit Impl(const std::string& path) : source(path), buffer(kPrefixBytes) {}

  // The next chunk of the stream, which stays valid until the next call; nullptr at its end.
  const fbs::PhotonChunk* next_chunk() {
    hash_before = source.content_hash();
    const size_t prefix = source.read(std::span(buffer).first(kPrefixBytes));
    if (prefix == 0) return nullptr;
    if (prefix < kPrefixBytes) fail_truncated();
    const size_t bytes = chunk_bytes(buffer);
    check_size(bytes);
    buffer.resize(std::max(buffer.size(), kPrefixBytes + bytes));
    if (source.read(std::span(buffer).subspan(kPrefixBytes, bytes)) < bytes) fail_truncated();
    chunk_size = kPrefixBytes + bytes;
    return &verified_chunk({buffer.data(), chunk_size}, source.name());
  }

  // Before the first chunk is trusted with a size, the file must look like ours.
  void read_header() {
    buffer.resize(kFileHeadBytes);
    const size_t count = source.read(buffer);
    check_flat_kind(source.name(), {buffer.data(), count}, FileKind::photons);
    const size_t bytes = chunk_bytes(buffer);
    check_size(bytes);
    buffer.resize(kPrefixBytes + bytes);
    const std::span<char> rest = std::span(buffer).subspan(kFileHeadBytes);
    if (source.read(rest) < rest.size()) fail_truncated();
    const auto* flat =
        verified_chunk({buffer.data(), buffer.size()}, source.name()).content_as_PhotonHeader();
    if (!flat) fail_damaged(source.name(), "it does not begin with a header");
    header = header_of(*flat, buffer.size(), source.name());
  }

  void read_block(const fbs::PhotonChunk& chunk, std::vector<Photon>& photons,
                  std::vector<Escape>& escapes, std::vector<MediumPhoton>& in_media) {
    if (const fbs::PhotonBlock* block = chunk.content_as_PhotonBlock())
      photons_of(*block, source.name(), &photons);
    else if (const fbs::SampleBlock* found = chunk.content_as_SampleBlock();
             found && header.stream.paths > 0)
      return read_samples(*found, photons);
    else if (const fbs::EscapeBlock* escaped = chunk.content_as_EscapeBlock())
      escapes_of(*escaped, source.name(), &escapes);
    else if (const fbs::MediumBlock* medium = chunk.content_as_MediumBlock();
             medium && header.stream.media)
      medium_photons_of(*medium, source.name(), &in_media);
    else
      fail_damaged(source.name(), "a chunk that is out of place");
    photons_read += photons.size();
    escapes_read += escapes.size();
    in_media_read += in_media.size();
  }

  void read_samples(const fbs::SampleBlock& found, std::vector<Photon>& samples) {
    samples_of(found, source.name(), &samples);
    samples_read += samples.size();
  }

  void read_end(const fbs::PhotonEnd& flat) {
    counts = counts_of(flat);
    check_count("photons", photons_read, counts.stored);
    check_count("samples of camera paths", samples_read, counts.samples);
    check_count("escapes", escapes_read, counts.escapes);
    check_count("photons in media", in_media_read, counts.in_media);
    if (flat.hash() != 0 && flat.hash() != hash_before)
      fail_damaged(source.name(), "its checksum is not that of its bytes");
    char extra;
    if (source.read({&extra, 1}) != 0) fail_damaged(source.name(), "data after its end");
    ended = true;
  }

  void check_count(const char* what, uint64_t read, uint64_t said) const {
    if (read != said)
      fail_damaged(source.name(), fmt::format("{} {}, and its end says {}", read, what, said));
  }

  void check_size(size_t bytes) const {
    if (bytes < kFileHeadBytes - kPrefixBytes || bytes > kMaxChunkBytes)
      fail_damaged(source.name(), fmt::format("a chunk of {} bytes", bytes));
  }

  [[noreturn]] void fail_truncated() const {
    fail("\"{}\": is truncated after {} photons: whoever wrote it did not finish", source.name(),
         photons_read);
  }

  ByteSource source;
  // From operator new, aligned for any scalar of a chunk.
  std::vector<char> buffer;
  size_t chunk_size = 0;
  PhotonHeader header;
  PhotonCounts counts;
  uint64_t photons_read = 0, samples_read = 0, escapes_read = 0, in_media_read = 0;
  std::vector<Escape> unwanted_escapes;
  std::vector<MediumPhoton> unwanted_in_media;
  uint64_t hash_before = 0;  // of the bytes before the chunk read last
  bool ended = false;
};

PhotonReader::PhotonReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  impl_->read_header();
}

PhotonReader::~PhotonReader() = default;

const PhotonHeader& PhotonReader::header() const { return impl_->header; }

bool PhotonReader::read(std::vector<Photon>* photons, std::vector<Escape>* escapes,
                        std::vector<MediumPhoton>* in_media) {
  if (!escapes) escapes = &impl_->unwanted_escapes;
  if (!in_media) in_media = &impl_->unwanted_in_media;
  photons->clear();
  escapes->clear();
  in_media->clear();
  if (impl_->ended) return false;
  const fbs::PhotonChunk* chunk = impl_->next_chunk();
  if (!chunk) impl_->fail_truncated();
  if (const fbs::PhotonEnd* end = chunk->content_as_PhotonEnd()) {
    impl_->read_end(*end);
    return false;
  }
  impl_->read_block(*chunk, *photons, *escapes, *in_media);
  return true;
}

double PhotonReader::share() const { return impl_->source.share(); }

const PhotonCounts& PhotonReader::counts() const { return impl_->counts; }

uint64_t PhotonReader::content_hash() const { return impl_->source.content_hash(); }

}  // namespace waylight
