#pragma once
// What the readers and writers of FlatBuffers files share.

#include <flatbuffers/flatbuffers.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/file_kind.h"
#include "formats/provenance.h"
#include "formats/provenance_generated.h"
#include "libguide/base/error.h"

namespace waylight {

// Throws Error unless so many bytes of bulk data, with what goes around them, fit into one buffer.
void check_flat_size(const std::string& path, size_t bulk_bytes, const char* remedy);

// Throws Error when the bytes cannot be a buffer of that kind; says which other kind they are.
void check_flat_kind(const std::string& path, std::string_view bytes, FileKind kind);

void check_format_version(const std::string& path, uint32_t version, uint32_t newest);

[[noreturn]] void fail_damaged(const std::string& path, std::string_view what);

// After the buffer, 16 bytes: a mark, and the XXH3 of the buffer. Whatever happens to a file, a
// changed byte, one too few or one too many shows; files of before have none.
inline constexpr std::string_view kSealMark = "WAYLSEAL";
std::string seal_of(std::string_view buffer);
void check_seal(const std::string& path, std::string_view bytes, bool sealed);

// Writes a finished buffer whose root says that it is sealed.
void write_sealed(const std::string& path, const flatbuffers::FlatBufferBuilder& builder);

// The root of a buffer, after all of it was verified.
template <typename Root>
const Root& verified_root(std::string_view bytes, const std::string& path, FileKind kind,
                          const char* identifier, uint32_t newest_version) {
  check_flat_kind(path, bytes, kind);
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  flatbuffers::Verifier verifier(data, bytes.size());
  if (!verifier.VerifyBuffer<Root>(identifier))
    fail_damaged(path, "truncated, or bytes were changed");
  const Root& root = *flatbuffers::GetRoot<Root>(data);
  check_format_version(path, root.format_version(), newest_version);
  check_seal(path, bytes, root.sealed());
  return root;
}

// Structs of a buffer as the records that have the same layout; FLAT_RECORD states which do.
template <typename Record>
struct FlatOf;

#define FLAT_RECORD(Record, Flat)                                                    \
  template <>                                                                        \
  struct FlatOf<Record> {                                                            \
    using type = Flat;                                                               \
  };                                                                                 \
  static_assert(sizeof(Record) == sizeof(Flat) && alignof(Record) == alignof(Flat)); \
  static_assert(std::is_standard_layout_v<Record>)

template <typename Record>
flatbuffers::Offset<flatbuffers::Vector<const typename FlatOf<Record>::type*>> add_records(
    flatbuffers::FlatBufferBuilder& builder, const std::vector<Record>& records) {
  using Flat = typename FlatOf<Record>::type;
  return builder.CreateVectorOfStructs(reinterpret_cast<const Flat*>(records.data()),
                                       records.size());
}

template <typename Record>
std::span<const Record> records_of(
    const flatbuffers::Vector<const typename FlatOf<Record>::type*>* vector,
    const std::string& path) {
  if (!vector || vector->size() == 0) return {};
  // The verifier looks at the length's alignment and not at that of the elements.
  if (reinterpret_cast<uintptr_t>(vector->Data()) % alignof(Record) != 0)
    fail_damaged(path, "misaligned data");
  return {reinterpret_cast<const Record*>(vector->Data()), vector->size()};
}

template <typename Record>
std::vector<Record> copy_of(std::span<const Record> records) {
  return {records.begin(), records.end()};
}

// Reads the strings of one buffer. A crafted buffer may refer to one string many times: together
// they must not be longer than the buffer.
class FlatStrings {
 public:
  FlatStrings(size_t buffer_bytes, const std::string& path) : left_(buffer_bytes), path_(path) {}
  std::string operator()(const flatbuffers::String* text);  // a missing one is empty

 private:
  size_t left_;
  const std::string& path_;
};

flatbuffers::Offset<fbs::Provenance> add_provenance(flatbuffers::FlatBufferBuilder& builder,
                                                    const Provenance& provenance);
Provenance provenance_from(const fbs::Provenance& flat, FlatStrings& strings);

size_t provenance_bytes(const Provenance& provenance);  // an upper bound, in a buffer

std::string_view bytes_of(const flatbuffers::FlatBufferBuilder& builder);

}  // namespace waylight
