#pragma once
// Eight floats that are computed on together: the structure-of-arrays lane of all mixtures.
// A vector type of the compiler, not a loop over an array: without -ffast-math a sum over an array
// has a fixed order and is not vectorised.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace waylight {

// Without AVX the compiler notes that such vectors are passed as AVX code would not: lanes never
// cross object files by value.
#pragma GCC diagnostic ignored "-Wpsabi"

using Lanes = float __attribute__((vector_size(32)));
using IntLanes = int32_t __attribute__((vector_size(32)));  // masks are 0 or -1 a lane
inline constexpr int kLanes = 8;

inline constexpr IntLanes kLaneIndex = {0, 1, 2, 3, 4, 5, 6, 7};

inline Lanes splat(float v) { return Lanes{v, v, v, v, v, v, v, v}; }
inline Lanes lanes_load(const float* from) {
  Lanes v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void lanes_store(Lanes v, float* to) { std::memcpy(to, &v, sizeof v); }
inline Lanes lanes_min(Lanes a, Lanes b) { return a < b ? a : b; }  // b where either is NaN
inline Lanes lanes_max(Lanes a, Lanes b) { return a > b ? a : b; }  // b where either is NaN

inline Lanes lanes_sqrt(Lanes v) {
  for (int i = 0; i < kLanes; ++i) v[i] = std::sqrt(v[i]);
  return v;
}

inline Lanes lanes_fma(Lanes a, Lanes b, Lanes c) {
  for (int i = 0; i < kLanes; ++i) c[i] = std::fma(a[i], b[i], c[i]);
  return c;
}

// a b - c d within 1.5 ulp even where the products cancel [Kahan; Jeannerod et al. 2013].
inline Lanes difference_of_products(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes cd = c * d;
  const Lanes error = lanes_fma(-c, d, cd);
  return lanes_fma(a, b, -cd) + error;
}

inline float lanes_sum(Lanes v) {
  v += __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
  v += __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5);
  v += __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
  return v[0];
}

// The sum in every lane.
inline Lanes lanes_sum_splat(Lanes v) {
  v += __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
  v += __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5);
  return v + __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
}

// Lane i holds the sum of lanes 0..i.
inline Lanes lanes_prefix_sum(Lanes v) {
  const Lanes zero = {};
  v += __builtin_shufflevector(v, zero, 8, 0, 1, 2, 3, 4, 5, 6);
  v += __builtin_shufflevector(v, zero, 8, 8, 0, 1, 2, 3, 4, 5);
  return v + __builtin_shufflevector(v, zero, 8, 8, 8, 8, 0, 1, 2, 3);
}

// How many lanes of a mask are set.
inline int lanes_count(IntLanes mask) {
  mask += __builtin_shufflevector(mask, mask, 4, 5, 6, 7, 0, 1, 2, 3);
  mask += __builtin_shufflevector(mask, mask, 2, 3, 0, 1, 6, 7, 4, 5);
  return -(mask[0] + mask[1]);
}

// The lane at which the running sum exceeds `target`, which is moved on by the sum before it; the
// last of `count` where none does.
inline int lanes_choose(Lanes weights, float& target, int count) {
  const Lanes cumulative = lanes_prefix_sum(weights);
  const int k = std::min(lanes_count(cumulative <= target), count - 1);
  const Lanes before = cumulative - weights;
  target -= before[k];
  return k;
}

}  // namespace waylight
