#pragma once
// Random numbers as a function of (seed, stream, index, dimension).
// Padded Owen-scrambled Sobol' points: each dimension (or pair) is a freshly shuffled and scrambled
// copy of the first two Sobol' dimensions [Burley 2020, Practical Hash-based Owen Scrambling].

#include <cstdint>

#include "libguide/math/types.h"

namespace waylight {

// A good 64-bit mix of its argument (splitmix64 finaliser).
constexpr uint64_t mix_bits(uint64_t v) {
  v ^= v >> 31;
  v *= 0x7fb5d329728ea185ull;
  v ^= v >> 27;
  v *= 0x81dadef4bc2dd44dull;
  v ^= v >> 33;
  return v;
}

constexpr uint64_t hash_combine(uint64_t a, uint64_t b) {
  return mix_bits(a ^ (mix_bits(b + 0x9e3779b97f4a7c15ull) + 0x9e3779b97f4a7c15ull));
}

// One sample of one stream (a pixel, or all photons of one pass). Copying it forks the sequence.
class Sampler {
 public:
  // index: number of the sample in its stream; successive indices are stratified together.
  Sampler(uint64_t seed, uint64_t stream, uint32_t index);

  float next();          // uniform in [0, 1)
  Vec2 next_2d();        // uniform in [0, 1)^2, stratified in both dimensions together
  uint64_t next_seed();  // of other generators; independent of all numbers of this one
  uint32_t dimension() const { return dimension_; }

 private:
  uint64_t key_;
  uint32_t reversed_index_;
  uint32_t dimension_ = 0;
};

}  // namespace waylight
