#pragma once
// *.photons: a stream of size-prefixed FlatBuffers chunks, so that it can be piped. Schema
// photons.fbs, identifier "WPHO". The first chunk is the header, the last one says how many photons
// went before it: a stream without it is truncated. Directions and normals lose what is beyond 7e-5
// radians.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/provenance.h"
#include "libguide/records/photon.h"

namespace waylight {

struct PhotonHeader {
  Provenance provenance;
  PhotonStreamInfo stream;
};

// Path "-" is stdout. A file appears under its name when finish() was called, and not otherwise.
class PhotonWriter {
 public:
  PhotonWriter(const std::string& path, const PhotonHeader& header);
  ~PhotonWriter();  // removes what finish() did not complete
  // Photons, and what camera paths found where header.stream.paths says that there are any.
  void write(std::span<const Photon> photons);
  void write(std::span<const Escape> escapes);        // in a stream of importance only
  void write(std::span<const MediumPhoton> photons);  // where header.stream.media says so
  // counts.stored, .samples, .escapes and .in_media must be the numbers written.
  void finish(const PhotonCounts& counts);
  uint64_t content_hash() const;  // of all bytes written so far

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Path "-" is stdin. Memory is bounded by one chunk.
class PhotonReader {
 public:
  explicit PhotonReader(const std::string& path);
  ~PhotonReader();
  const PhotonHeader& header() const;
  // The next photons of one kind, or false at the end; what camera paths found comes as photons;
  // who gives no place for escapes or for photons in media passes over them. Throws Error for a
  // chunk that is damaged, out of place or missing, and for photons whose position or power is not
  // finite or whose power is negative.
  bool read(std::vector<Photon>* photons, std::vector<Escape>* escapes = nullptr,
            std::vector<MediumPhoton>* in_media = nullptr);
  double share() const;                // of the file that was read; 0 for a pipe
  const PhotonCounts& counts() const;  // after read() said false
  uint64_t content_hash() const;       // of all bytes of the stream, after read() said false

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace waylight
