#include "libguide/guiding/primary_table.h"

namespace waylight {
namespace {

int index_of(float x, int count) {
  return std::clamp(static_cast<int>(x * static_cast<float>(count)), 0, count - 1);
}

float place(int index, float inside, int count) {
  return std::min((static_cast<float>(index) + inside) / static_cast<float>(count),
                  kOneMinusEpsilon);
}

}  // namespace

PrimaryTable::PrimaryTable(std::span<const float> weights, int slices, int side)
    : cells_(weights), slices_(slices), side_(side) {}

PrimaryTable::Point PrimaryTable::sample(float u, const Vec2& v) const {
  if (cells_.empty()) return {u, v};
  const Discrete::Sample chosen = cells_.sample(u);
  const int row = chosen.index / side_ % side_, column = chosen.index % side_;
  return {place(chosen.index / (side_ * side_), chosen.u, slices_),
          {place(column, v.x(), side_), place(row, v.y(), side_)}};
}

float PrimaryTable::pdf(const Point& at) const {
  if (cells_.empty()) return 1;
  const int slice = index_of(at.u, slices_);
  const int row = index_of(at.v.y(), side_), column = index_of(at.v.x(), side_);
  return cells_.prob((slice * side_ + row) * side_ + column) * static_cast<float>(cells_.size());
}

PrimaryTable::Point PrimaryTable::middle(int cell, int slices, int side, int part, int parts) {
  const float x = (part % parts + 0.5f) / parts, y = (part / parts + 0.5f) / parts;
  return {place(cell / (side * side), 0.5f, slices),
          {place(cell % side, x, side), place(cell / side % side, y, side)}};
}

}  // namespace waylight
