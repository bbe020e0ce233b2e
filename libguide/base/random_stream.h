#pragma once

#include "libguide/base/sampler.h"

namespace waylight {

// Independent uniform numbers for loops of unknown length, such as tracking through a medium: they
// need no stratification, and cost a third of a Sampler's. A function of two numbers of the path.
class RandomStream {
 public:
  explicit RandomStream(Sampler& path) {
    const auto high = static_cast<uint64_t>(path.next() * 0x1p24f);
    const auto low = static_cast<uint64_t>(path.next() * 0x1p24f);
    state_ = mix_bits((high << 24 | low) + 1);
  }

  float next() {  // uniform in [0, 1)
    state_ += 0x9e3779b97f4a7c15ull;
    return static_cast<float>(mix_bits(state_) >> 40) * 0x1p-24f;
  }

 private:
  uint64_t state_;
};

}  // namespace waylight
