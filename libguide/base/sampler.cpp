#include "libguide/base/sampler.h"

namespace waylight {
namespace {

uint32_t reverse_bits(uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v >> 4) & 0x0f0f0f0fu);
  v = ((v & 0x33333333u) << 2) | ((v >> 2) & 0x33333333u);
  return ((v & 0x55555555u) << 1) | ((v >> 1) & 0x55555555u);
}

// Laine-Karras style permutation with the constants of Vegdahl 2021; acts on reversed bits.
uint32_t permute_reversed(uint32_t v, uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return v;
}

// Second Sobol' dimension of index i: the Pascal matrix modulo 2, bit-reversed.
uint32_t sobol_second(uint32_t i) {
  uint32_t column = 0x80000000u, result = 0;
  for (; i; i >>= 1, column ^= column >> 1)
    if (i & 1) result ^= column;
  return result;
}

uint32_t owen(uint32_t v, uint32_t seed) {
  return reverse_bits(permute_reversed(reverse_bits(v), seed));
}

float to_unit(uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }

}  // namespace

float Sampler::next() {
  const uint64_t key = hash_combine(key_, dimension_++);
  const uint32_t shuffled = owen(index_, static_cast<uint32_t>(key));
  return to_unit(owen(reverse_bits(shuffled), static_cast<uint32_t>(key >> 32)));
}

Vec2 Sampler::next_2d() {
  const uint64_t key = hash_combine(key_, dimension_);
  dimension_ += 2;
  const uint32_t shuffled = owen(index_, static_cast<uint32_t>(key));
  const uint64_t scramble = mix_bits(key + 1);
  return {to_unit(owen(reverse_bits(shuffled), static_cast<uint32_t>(scramble))),
          to_unit(owen(sobol_second(shuffled), static_cast<uint32_t>(scramble >> 32)))};
}

}  // namespace waylight
