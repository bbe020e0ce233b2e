#pragma once

#include "libguide/base/sampler.h"

namespace waylight {

// The random numbers of one of the copies into which a path is split: a function of all that makes
// the path's own, of its dimension and of `copy`. Copies of one split are stratified together,
// those of different splits are independent: two numbers of the path, 48 bits, are their seed.
inline Sampler split_sampler(Sampler path, uint32_t copy) {
  const auto high = static_cast<uint64_t>(path.next() * 0x1p24f);
  const auto low = static_cast<uint64_t>(path.next() * 0x1p24f);
  return Sampler(high << 24 | low, path.dimension(), copy);
}

}  // namespace waylight
