#include "formats/byte_stream.h"
#include "formats/photon_chunk.h"
#include "formats/photon_file.h"

namespace waylight {

struct PhotonWriter::Impl {
  explicit Impl(const std::string& file) : path(file), sink(file) {
    photons.records.reserve(kPhotonsPerChunk);
  }

  void write_chunk() { sink.write(bytes_of(builder)); }

  // Chunks are cut after equal numbers of records, however the records come.
  void append(const Photon& photon) {
    const bool sample = photon.from == TracedFrom::camera;
    if (sample && !paths)
      fail("\"{}\": what camera paths found, in a stream whose header says that there are none",
           path);
    append(photon, sample ? samples : photons);
  }
  void append(const Escape& escape) { append(escape, escapes); }
  void append(const MediumPhoton& photon) { append(photon, in_media); }

  // Records that wait for their chunk to fill.
  template <typename Flat>
  struct Waiting {
    void (*build)(flatbuffers::FlatBufferBuilder&, std::span<const Flat>);
    std::vector<Flat> records = {};
    uint64_t written = 0;
  };

  template <typename Record, typename Flat>
  void append(const Record& record, Waiting<Flat>& waiting) {
    waiting.records.push_back(pack(record, path));
    if (waiting.records.size() == kPhotonsPerChunk) flush(waiting);
  }

  template <typename Flat>
  void flush(Waiting<Flat>& waiting) {
    if (waiting.records.empty()) return;
    waiting.build(builder, waiting.records);
    write_chunk();
    waiting.written += waiting.records.size();
    waiting.records.clear();
  }

  void finish(const PhotonCounts& counts);
  void check_count(const char* what, uint64_t written, uint64_t counted) const {
    if (written != counted)
      fail("\"{}\": {} {} were written, {} counted", path, written, what, counted);
  }

  std::string path;
  ByteSink sink;
  flatbuffers::FlatBufferBuilder builder;
  Waiting<fbs::Photon> photons{build_block}, samples{build_sample_block};
  Waiting<fbs::Escape> escapes{build_block};
  Waiting<fbs::MediumPhoton> in_media{build_block};
  Quantity quantity;
  bool media, paths;
};

PhotonWriter::PhotonWriter(const std::string& path, const PhotonHeader& header)
    : impl_(std::make_unique<Impl>(path)) {
  impl_->quantity = header.stream.quantity;
  impl_->media = header.stream.media;
  impl_->paths = header.stream.paths > 0;
  build_header(impl_->builder, header, path);
  impl_->write_chunk();
}

PhotonWriter::~PhotonWriter() = default;

void PhotonWriter::write(std::span<const Photon> photons) {
  for (const Photon& photon : photons) impl_->append(photon);
}

void PhotonWriter::write(std::span<const Escape> escapes) {
  if (impl_->quantity != Quantity::importance && !escapes.empty())
    fail("\"{}\": only importons escape, and the stream holds radiance", impl_->path);
  for (const Escape& escape : escapes) impl_->append(escape);
}

void PhotonWriter::write(std::span<const MediumPhoton> photons) {
  if (!impl_->media && !photons.empty())
    fail("\"{}\": photons in media, in a stream whose header says that there are none",
         impl_->path);
  for (const MediumPhoton& photon : photons) impl_->append(photon);
}

void PhotonWriter::Impl::finish(const PhotonCounts& counts) {
  flush(photons);
  flush(samples);
  flush(escapes);
  flush(in_media);
  check_count("photons", photons.written, counts.stored);
  check_count("samples of camera paths", samples.written, counts.samples);
  check_count("escapes", escapes.written, counts.escapes);
  check_count("photons in media", in_media.written, counts.in_media);
  build_end(builder, counts, sink.content_hash());
  write_chunk();
  sink.commit();
}

void PhotonWriter::finish(const PhotonCounts& counts) { impl_->finish(counts); }

uint64_t PhotonWriter::content_hash() const { return impl_->sink.content_hash(); }

}  // namespace waylight
