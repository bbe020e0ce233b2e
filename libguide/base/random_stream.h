#pragma once

#include "libguide/base/sampler.h"

namespace waylight {

// Independent uniform numbers for loops of unknown length, such as tracking through a medium: they
// need no stratification, and cost a fifteenth of a Sampler's.
class RandomStream {
 public:
  explicit RandomStream(Sampler& path) : state_(path.next_seed()) {}

  float next() {  // uniform in [0, 1)
    state_ += 0x9e3779b97f4a7c15ull;
    return static_cast<float>(mix_bits(state_) >> 40) * 0x1p-24f;
  }

 private:
  uint64_t state_;
};

}  // namespace waylight
