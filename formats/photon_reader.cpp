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

  void read_end(const fbs::PhotonEnd& flat) {
    counts = counts_of(flat);
    if (counts.stored != photons_read)
      fail_damaged(source.name(),
                   fmt::format("{} photons, and its end says {}", photons_read, counts.stored));
    if (counts.escapes != escapes_read)
      fail_damaged(source.name(),
                   fmt::format("{} escapes, and its end says {}", escapes_read, counts.escapes));
    char extra;
    if (source.read({&extra, 1}) != 0) fail_damaged(source.name(), "data after its end");
    ended = true;
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
  uint64_t photons_read = 0, escapes_read = 0;
  std::vector<Escape> unwanted;
  bool ended = false;
};

PhotonReader::PhotonReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {
  impl_->read_header();
}

PhotonReader::~PhotonReader() = default;

const PhotonHeader& PhotonReader::header() const { return impl_->header; }

bool PhotonReader::read(std::vector<Photon>* photons, std::vector<Escape>* escapes) {
  if (!escapes) escapes = &impl_->unwanted;
  photons->clear();
  escapes->clear();
  if (impl_->ended) return false;
  const fbs::PhotonChunk* chunk = impl_->next_chunk();
  if (!chunk) impl_->fail_truncated();
  if (const fbs::PhotonEnd* end = chunk->content_as_PhotonEnd()) {
    impl_->read_end(*end);
    return false;
  }
  if (const fbs::EscapeBlock* block = chunk->content_as_EscapeBlock()) {
    escapes_of(*block, impl_->source.name(), escapes);
    impl_->escapes_read += escapes->size();
    return true;
  }
  const fbs::PhotonBlock* block = chunk->content_as_PhotonBlock();
  if (!block) fail_damaged(impl_->source.name(), "a chunk that is out of place");
  photons_of(*block, impl_->source.name(), photons);
  impl_->photons_read += photons->size();
  return true;
}

const PhotonCounts& PhotonReader::counts() const { return impl_->counts; }

uint64_t PhotonReader::content_hash() const { return impl_->source.content_hash(); }

}  // namespace waylight
