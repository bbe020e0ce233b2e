#pragma once
// The hash of everything that files say of each other: XXH3, 64 bits, streaming.

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdint>
#include <string_view>

namespace waylight {

class ContentHash {
 public:
  ContentHash() { XXH3_64bits_reset(&state_); }

  void add(const void* data, size_t bytes) { XXH3_64bits_update(&state_, data, bytes); }
  void add(std::string_view bytes) { add(bytes.data(), bytes.size()); }
  uint64_t value() const { return XXH3_64bits_digest(&state_); }

 private:
  XXH3_state_t state_;
};

}  // namespace waylight
