#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

namespace waylight {

// The hash of everything that files say of each other: XXH3, 64 bits, streaming.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();

  void add(const void* data, size_t bytes);
  void add(std::string_view bytes) { add(bytes.data(), bytes.size()); }
  uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace waylight
