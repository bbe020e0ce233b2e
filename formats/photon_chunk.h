#pragma once
// The chunks of a photon stream as bytes.

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "formats/flat_file.h"
#include "formats/photon_file.h"
#include "formats/photons_generated.h"

namespace waylight {

inline constexpr size_t kPhotonsPerChunk = 16384;  // 576 KiB: stays in the second-level cache
// Of what a reader accepts, its size prefix left out.
inline constexpr size_t kMaxChunkBytes = size_t{4} << 20;

// The photon as it is stored; throws Error for one that the reader would refuse. `path` is for
// messages.
fbs::Photon pack(const Photon& photon, const std::string& path);
fbs::Escape pack(const Escape& escape, const std::string& path);
fbs::MediumPhoton pack(const MediumPhoton& photon, const std::string& path);

// Each replaces what the builder held by one finished chunk.
void build_header(flatbuffers::FlatBufferBuilder& builder, const PhotonHeader& header,
                  const std::string& path);
void build_block(flatbuffers::FlatBufferBuilder& builder, std::span<const fbs::Photon> photons);
void build_block(flatbuffers::FlatBufferBuilder& builder, std::span<const fbs::Escape> escapes);
void build_block(flatbuffers::FlatBufferBuilder& builder,
                 std::span<const fbs::MediumPhoton> photons);
void build_sample_block(flatbuffers::FlatBufferBuilder& builder,
                        std::span<const fbs::Photon> samples);
// hash: of all bytes before.
void build_end(flatbuffers::FlatBufferBuilder& builder, const PhotonCounts& counts, uint64_t hash);

// A chunk with its size prefix, verified.
const fbs::PhotonChunk& verified_chunk(std::string_view bytes, const std::string& path);

PhotonHeader header_of(const fbs::PhotonHeader& flat, size_t chunk_bytes, const std::string& path);
void photons_of(const fbs::PhotonBlock& flat, const std::string& path,
                std::vector<Photon>* photons);
void samples_of(const fbs::SampleBlock& flat, const std::string& path,
                std::vector<Photon>* samples);
void escapes_of(const fbs::EscapeBlock& flat, const std::string& path,
                std::vector<Escape>* escapes);
void medium_photons_of(const fbs::MediumBlock& flat, const std::string& path,
                       std::vector<MediumPhoton>* photons);
PhotonCounts counts_of(const fbs::PhotonEnd& flat);

}  // namespace waylight
