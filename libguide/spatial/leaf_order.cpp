#include "libguide/spatial/leaf_order.h"

namespace waylight {

void LeafOrder::sort(std::span<const uint32_t> leaf_of_point, size_t leaves) {
  begin_.assign(leaves + 1, 0);
  for (uint32_t leaf : leaf_of_point)
    if (leaf != kNone) ++begin_[leaf + 1];
  occupied_.clear();
  for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
    if (begin_[leaf + 1] > 0) occupied_.push_back(leaf);
    begin_[leaf + 1] += begin_[leaf];
  }
  order_.resize(begin_[leaves]);
  next_ = begin_;
  for (uint32_t i = 0; i < leaf_of_point.size(); ++i)
    if (leaf_of_point[i] != kNone) order_[next_[leaf_of_point[i]]++] = i;
}

}  // namespace waylight
