#pragma once
// Tabulated distributions: discrete, and piecewise constant over [0, 1) and [0, 1)^2.

#include <cstdint>
#include <span>
#include <vector>

#include "libguide/math/types.h"

namespace waylight {

// Indices with probability proportional to non-negative weights. An index of weight zero is never
// sampled; a table whose weights are all zero is empty() and must not be sampled.
//
// Sampling inverts the distribution function; the search begins in the part of it that a table of
// equal steps of u names [Chen and Asau 1974], some four indices long on average.
class Discrete {
 public:
  struct Sample {
    int index;
    float prob;
    float u;  // what is left of the random number: uniform in [0, 1) again
  };

  Discrete() = default;
  explicit Discrete(std::span<const float> weights);

  float prob(int index) const { return cdf_[index + 1] - cdf_[index]; }
  Sample sample(float u) const;

  // Probability of all indices below this one.
  float cdf(int index) const { return cdf_[index]; }
  int size() const { return static_cast<int>(cdf_.size()) - 1; }
  bool empty() const { return total_ <= 0; }
  double total() const { return total_; }  // of the weights

 private:
  void index();

  std::vector<float> cdf_{0};
  std::vector<uint32_t> first_{0, 0};  // the last index whose cdf is at most k / steps
  float steps_ = 1;                    // a power of two, so that u * steps is exact
  double total_ = 0;
};

// Constant density on each of n equal cells of [0, 1).
class PiecewiseConstant1d {
 public:
  struct Sample {
    float x;
    float pdf;
    int cell;
    float inside;  // place within the cell, [0, 1)
  };

  PiecewiseConstant1d() = default;
  explicit PiecewiseConstant1d(std::span<const float> weights) : cells_(weights) {}

  float cell_prob(int cell) const { return cells_.prob(cell); }
  Sample sample(float u) const;

  int size() const { return cells_.size(); }
  double total() const { return cells_.total(); }
  bool empty() const { return cells_.empty(); }

 private:
  Discrete cells_;
};

// Constant density on each cell of a width x height grid over [0, 1)^2: rows by their sums, then
// columns within the row. weights: row by row.
class PiecewiseConstant2d {
 public:
  struct Sample {
    Vec2 p;
    float pdf;
    int column, row;
    Vec2 inside;  // place within the cell, [0, 1)^2
  };

  PiecewiseConstant2d() = default;
  PiecewiseConstant2d(std::span<const float> weights, int width, int height);

  float cell_prob(int column, int row) const {
    return rows_.cell_prob(row) * columns_[row].cell_prob(column);
  }
  Sample sample(const Vec2& u) const;

  double total() const { return rows_.total(); }
  bool empty() const { return rows_.empty(); }

 private:
  PiecewiseConstant1d rows_;
  std::vector<PiecewiseConstant1d> columns_;  // an empty row is never reached
};

}  // namespace waylight
