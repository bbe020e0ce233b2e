#pragma once
// A density over the random numbers that a sampling routine takes, in which it is itself uniform.

#include "libguide/math/distribution.h"

namespace waylight {

// Piecewise constant over (u, v) in [0, 1) x [0, 1)^2: `slices` along u, `side` along each axis of
// v. A default-constructed one is uniform.
class PrimaryTable {
 public:
  struct Point {
    float u;
    Vec2 v;
  };

  PrimaryTable() = default;
  // weights: slice by slice, row by row; all zero: uniform.
  PrimaryTable(std::span<const float> weights, int slices, int side);

  Point sample(float u, const Vec2& v) const;
  float pdf(const Point& at) const;

  // Middle of a part of a cell: `parts` along each axis of v.
  static Point middle(int cell, int slices, int side, int part, int parts);

 private:
  Discrete cells_;
  int slices_ = 1, side_ = 1;
};

}  // namespace waylight
