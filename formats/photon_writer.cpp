#include "formats/byte_stream.h"
#include "formats/photon_chunk.h"
#include "formats/photon_file.h"

namespace waylight {

struct PhotonWriter::Impl {
  explicit Impl(const std::string& file) : path(file), sink(file) {
    pending.reserve(kPhotonsPerChunk);
  }

  void write_chunk() { sink.write(bytes_of(builder)); }

  // Chunks are cut after equal numbers of photons, however the photons come.
  void flush() {
    if (pending.empty()) return;
    build_block(builder, pending);
    write_chunk();
    stored += pending.size();
    pending.clear();
  }

  std::string path;
  ByteSink sink;
  flatbuffers::FlatBufferBuilder builder;
  std::vector<fbs::Photon> pending;
  uint64_t stored = 0;
};

PhotonWriter::PhotonWriter(const std::string& path, const PhotonHeader& header)
    : impl_(std::make_unique<Impl>(path)) {
  build_header(impl_->builder, header, path);
  impl_->write_chunk();
}

PhotonWriter::~PhotonWriter() = default;

void PhotonWriter::write(std::span<const Photon> photons) {
  for (const Photon& photon : photons) {
    impl_->pending.push_back(pack(photon, impl_->path));
    if (impl_->pending.size() == kPhotonsPerChunk) impl_->flush();
  }
}

void PhotonWriter::finish(const PhotonCounts& counts) {
  impl_->flush();
  if (counts.stored != impl_->stored)
    fail("\"{}\": {} photons were written and {} counted", impl_->path, impl_->stored,
         counts.stored);
  build_end(impl_->builder, counts);
  impl_->write_chunk();
  impl_->sink.commit();
}

uint64_t PhotonWriter::content_hash() const { return impl_->sink.content_hash(); }

}  // namespace waylight
