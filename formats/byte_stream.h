#pragma once
// Bytes out of and into files and pipes, counted into a hash.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/atomic_file.h"
#include "formats/content_hash.h"

namespace waylight {

// A file descriptor that closes itself, unless it is one of the standard streams.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }
  bool close();  // false when the system says that data was lost

 private:
  int value_;
};

// "-" is stdout; a file has its name after commit() only. All errors name the path, a reader that
// went away too.
class ByteSink {
 public:
  explicit ByteSink(const std::string& path);
  void write(std::string_view bytes);
  void commit();
  uint64_t content_hash() const { return hash_.value(); }

 private:
  std::string name_;
  std::optional<AtomicFile> file_;
  Descriptor descriptor_;
  ContentHash hash_;
};

// "-" is stdin.
class ByteSource {
 public:
  explicit ByteSource(const std::string& path);
  // Fills the buffer unless the stream ends before; returns how many bytes there were.
  size_t read(std::span<char> buffer);
  const std::string& name() const { return name_; }  // for messages
  // Of all bytes those read so far; 0 where it is not known how many there are.
  double share() const { return size_ > 0 ? double(read_) / double(size_) : 0; }
  uint64_t content_hash() const { return hash_.value(); }

 private:
  std::string name_;
  Descriptor descriptor_;
  ContentHash hash_;
  uint64_t read_ = 0, size_ = 0;
};

}  // namespace waylight
