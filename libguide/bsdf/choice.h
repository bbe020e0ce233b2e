#pragma once
// Choosing between two parts of a lobe.

#include "libguide/math/types.h"

namespace waylight {

// Probability of the first of two parts of importance a and b: 0 or 1 only where a part is black.
// The floor keeps weights bounded where the importances are rough estimates.
inline float choice_prob(float a, float b, float floor = 0) {
  if (!(a > 0)) return 0;
  if (!(b > 0)) return 1;
  return std::clamp(a / (a + b), floor, 1 - floor);
}

// Value and density of one direction, computed together because they share most terms.
struct EvalPdf {
  Color value = Color::Zero();
  float pdf = 0;
};

}  // namespace waylight
