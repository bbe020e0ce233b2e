#pragma once

#include <algorithm>
#include <limits>

namespace waylight {

// A value of at least 0 as a float, the largest one where it is beyond.
inline float saturated(double v) {
  return static_cast<float>(std::min<double>(v, std::numeric_limits<float>::max()));
}

}  // namespace waylight
