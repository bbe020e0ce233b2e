#pragma once
// Whole files in memory and bounds-checked reading of them. Little-endian hosts only.

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "libguide/base/error.h"

namespace waylight {

static_assert(std::endian::native == std::endian::little);

// The content of a regular file; throws Error naming the path and the system's reason.
std::string read_whole_file(const std::string& path);
// Replaces the file at `path` when all bytes are written.
void write_whole_file(const std::string& path, std::string_view bytes);

// A cursor over bytes of the file `path`; every read past their end is an Error that names it.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string path) : bytes_(bytes), path_(std::move(path)) {}

  template <typename T>
  T read() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  std::string_view take(size_t count) {
    if (count > bytes_.size())
      fail("\"{}\": truncated: {} more bytes are needed, {} are left", path_, count, bytes_.size());
    const std::string_view head = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return head;
  }

  size_t remaining() const { return bytes_.size(); }
  const std::string& path() const { return path_; }

 private:
  std::string_view bytes_;
  std::string path_;
};

}  // namespace waylight
