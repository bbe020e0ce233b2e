#pragma once

#include <cmath>
#include <initializer_list>

namespace waylight {

// What sums, counts and energies of a file have to be.
inline bool finite_and_not_negative(std::initializer_list<double> values) {
  for (const double v : values)
    if (!std::isfinite(v) || v < 0) return false;
  return true;
}

}  // namespace waylight
