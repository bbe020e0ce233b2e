#include "libguide/transport/split_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace waylight {
namespace {

TEST(SplitSampler, CopiesAreStratifiedTogether) {
  Sampler path(3, 5, 7);
  path.next();
  std::vector<int> columns(16), squares(16);
  for (int copy = 0; copy < 16; ++copy) {
    Sampler sampler = split_sampler(path, copy);
    ++columns[static_cast<int>(sampler.next() * 16)];
    const Vec2 u = sampler.next_2d();
    ++squares[static_cast<int>(u.x() * 4) * 4 + static_cast<int>(u.y() * 4)];
  }
  EXPECT_EQ(columns, std::vector<int>(16, 1));
  EXPECT_EQ(squares, std::vector<int>(16, 1));
}

TEST(SplitSampler, IsAFunctionOfPathDimensionAndCopyAndDiffersInEach) {
  std::set<float> seen;
  for (uint32_t index = 0; index < 50; ++index) {
    Sampler path(3, 5, index);
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (int copy = 0; copy < 4; ++copy) {
        EXPECT_EQ(split_sampler(path, copy).next(), split_sampler(path, copy).next());
        seen.insert(split_sampler(path, copy).next());
      }
      seen.insert(path.next());
    }
  }
  EXPECT_GT(seen.size(), 995u);  // of 1000: 24 bits may meet by chance
}

TEST(SplitSampler, CopiesOfSuccessiveSamplesAreUncorrelated) {
  constexpr int kCount = 4096;
  double product = 0;
  for (int i = 0; i < kCount; ++i)
    product += (split_sampler(Sampler(3, 5, i), 1).next() - 0.5) *
               (split_sampler(Sampler(3, 5, i + 1), 1).next() - 0.5);
  // The product of two uniform numbers about their mean has standard deviation 1 / 12.
  EXPECT_LT(std::abs(product / kCount), 4.0 / 12 / std::sqrt(kCount));
}

}  // namespace
}  // namespace waylight
