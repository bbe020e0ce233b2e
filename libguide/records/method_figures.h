#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace waylight {

// What a pilot saw of one way to trace paths. Per path: relative variance of its pixel, and its
// cost, in processor seconds or rays. uncertainty: standard error of the logarithm of their product
// over that of the first way.
struct MethodFigures {
  std::string name;
  double variance = 0, cost = 0, uncertainty = 0;

  double inefficiency() const { return variance * cost; }
};

// What mode auto decided, and why.
struct AutoDecision {
  std::string method = "bsdf";  // what was taken, in words
  std::vector<MethodFigures> compared;
  size_t cells_bsdf = 0, cells_illumination = 0, cells_product = 0;  // by what they are sampled
  std::string fits;    // what became of the fitted BSDFs, in words; empty: there are none
  double seconds = 0;  // of the pilot
};

}  // namespace waylight
