#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace waylight {

// The indices of a block of points grouped by leaf, in order of arrival within each: a counting
// sort, whose buffers are kept from block to block.
class LeafOrder {
 public:
  static constexpr uint32_t kNone = 0xffffffff;  // the leaf of a point that belongs to none

  void sort(std::span<const uint32_t> leaf_of_point, size_t leaves);

  std::span<const uint32_t> points(size_t leaf) const {
    return std::span(order_).subspan(begin_[leaf], begin_[leaf + 1] - begin_[leaf]);
  }
  std::span<const uint32_t> occupied() const {
    return occupied_;
  }  // leaves with a point, ascending

 private:
  std::vector<uint32_t> begin_, order_, occupied_, next_;
};

}  // namespace waylight
