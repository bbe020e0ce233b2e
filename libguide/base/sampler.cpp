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

// Bit-reversed second Sobol' dimension of index i: the Pascal matrix modulo 2, which is the fifth
// Kronecker power of ((1, 1), (0, 1)), so that each factor takes one step.
uint32_t reversed_sobol_second(uint32_t i) {
  i ^= (i >> 1) & 0x55555555u;
  i ^= (i >> 2) & 0x33333333u;
  i ^= (i >> 4) & 0x0f0f0f0fu;
  i ^= (i >> 8) & 0x00ff00ffu;
  return i ^ (i >> 16);
}

// Owen scrambling of the number whose bits are given in reverse.
uint32_t owen_reversed(uint32_t reversed, uint32_t seed) {
  return reverse_bits(permute_reversed(reversed, seed));
}

float to_unit(uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }

}  // namespace

Sampler::Sampler(uint64_t seed, uint64_t stream, uint32_t index)
    : key_(hash_combine(seed, stream)), reversed_index_(reverse_bits(index)) {}

float Sampler::next() {
  const uint64_t key = hash_combine(key_, dimension_++);
  const uint32_t shuffled = owen_reversed(reversed_index_, static_cast<uint32_t>(key));
  return to_unit(owen_reversed(shuffled, static_cast<uint32_t>(key >> 32)));
}

Vec2 Sampler::next_2d() {
  const uint64_t key = hash_combine(key_, dimension_);
  dimension_ += 2;
  const uint32_t shuffled = owen_reversed(reversed_index_, static_cast<uint32_t>(key));
  const uint64_t scramble = mix_bits(key + 1);
  return {to_unit(owen_reversed(shuffled, static_cast<uint32_t>(scramble))),
          to_unit(owen_reversed(reversed_sobol_second(shuffled),
                                static_cast<uint32_t>(scramble >> 32)))};
}

uint64_t Sampler::next_seed() {
  return hash_combine(hash_combine(key_, dimension_++), reversed_index_);
}

}  // namespace waylight
