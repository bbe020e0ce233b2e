#include "formats/byte_stream.h"
#include "formats/photon_chunk.h"
#include "formats/photon_file.h"

namespace waylight {

struct PhotonWriter::Impl {
  explicit Impl(const std::string& file) : path(file), sink(file) {
    pending.reserve(kPhotonsPerChunk);
  }

  void write_chunk() { sink.write(bytes_of(builder)); }

  // Chunks are cut after equal numbers of records, however the records come.
  template <typename Record, typename Flat>
  void append(std::span<const Record> records, std::vector<Flat>& waiting, uint64_t& written) {
    for (const Record& record : records) {
      waiting.push_back(pack(record, path));
      if (waiting.size() == kPhotonsPerChunk) flush(waiting, written);
    }
  }

  template <typename Flat>
  void flush(std::vector<Flat>& waiting, uint64_t& written) {
    if (waiting.empty()) return;
    build_block(builder, waiting);
    write_chunk();
    written += waiting.size();
    waiting.clear();
  }

  std::string path;
  ByteSink sink;
  flatbuffers::FlatBufferBuilder builder;
  std::vector<fbs::Photon> pending;
  std::vector<fbs::Escape> pending_escapes;
  std::vector<fbs::MediumPhoton> pending_in_media;
  uint64_t stored = 0, escapes = 0, in_media = 0;
  Quantity quantity;
  bool media;
};

PhotonWriter::PhotonWriter(const std::string& path, const PhotonHeader& header)
    : impl_(std::make_unique<Impl>(path)) {
  impl_->quantity = header.stream.quantity;
  impl_->media = header.stream.media;
  build_header(impl_->builder, header, path);
  impl_->write_chunk();
}

PhotonWriter::~PhotonWriter() = default;

void PhotonWriter::write(std::span<const Photon> photons) {
  impl_->append(photons, impl_->pending, impl_->stored);
}

void PhotonWriter::write(std::span<const Escape> escapes) {
  if (impl_->quantity != Quantity::importance && !escapes.empty())
    fail("\"{}\": only importons escape, and the stream holds radiance", impl_->path);
  impl_->append(escapes, impl_->pending_escapes, impl_->escapes);
}

void PhotonWriter::write(std::span<const MediumPhoton> photons) {
  if (!impl_->media && !photons.empty())
    fail("\"{}\": photons in media, in a stream whose header says that there are none",
         impl_->path);
  impl_->append(photons, impl_->pending_in_media, impl_->in_media);
}

void PhotonWriter::finish(const PhotonCounts& counts) {
  impl_->flush(impl_->pending, impl_->stored);
  impl_->flush(impl_->pending_escapes, impl_->escapes);
  impl_->flush(impl_->pending_in_media, impl_->in_media);
  if (counts.stored != impl_->stored || counts.escapes != impl_->escapes ||
      counts.in_media != impl_->in_media)
    fail(
        "\"{}\": {} photons, {} escapes and {} photons in media were written, {}, {} and {} "
        "counted",
        impl_->path, impl_->stored, impl_->escapes, impl_->in_media, counts.stored, counts.escapes,
        counts.in_media);
  build_end(impl_->builder, counts);
  impl_->write_chunk();
  impl_->sink.commit();
}

uint64_t PhotonWriter::content_hash() const { return impl_->sink.content_hash(); }

}  // namespace waylight
