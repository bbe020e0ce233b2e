#include "libguide/spatial/leaf_order.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

std::vector<uint32_t> points(const LeafOrder& order, size_t leaf) {
  return {order.points(leaf).begin(), order.points(leaf).end()};
}

TEST(LeafOrder, GroupsByLeafAndKeepsTheOrderOfArrival) {
  LeafOrder order;
  order.sort(std::vector<uint32_t>{3, 0, 3, LeafOrder::kNone, 0, 3}, 5);
  EXPECT_EQ(points(order, 0), (std::vector<uint32_t>{1, 4}));
  EXPECT_EQ(points(order, 3), (std::vector<uint32_t>{0, 2, 5}));
  EXPECT_TRUE(order.points(1).empty() && order.points(2).empty() && order.points(4).empty());
  EXPECT_EQ(std::vector<uint32_t>(order.occupied().begin(), order.occupied().end()),
            (std::vector<uint32_t>{0, 3}));
}

TEST(LeafOrder, ForgetsTheBlockBefore) {
  LeafOrder order;
  order.sort(std::vector<uint32_t>{1, 1, 1}, 2);
  order.sort(std::vector<uint32_t>{0}, 1);
  EXPECT_EQ(points(order, 0), std::vector<uint32_t>{0});
  order.sort({}, 3);
  EXPECT_TRUE(order.occupied().empty());
}

}  // namespace
}  // namespace waylight
