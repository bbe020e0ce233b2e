#include "libguide/math/fast_log.h"

#include <gtest/gtest.h>

#include <cmath>

namespace waylight {
namespace {

TEST(LanesLog2, IsAccurateOverAllNormalFloats) {
  for (int exponent = -125; exponent < 127; ++exponent)
    for (int i = 0; i < 64; ++i) {
      const float v = std::ldexp(1 + i / 64.0f, exponent);
      const double expected = std::log2(double{v});
      EXPECT_NEAR(lanes_log2(splat(v))[i % kLanes], expected, 2e-7 + 1e-7 * std::abs(expected))
          << v;
    }
}

TEST(LanesLog2, OfOneIsZero) { EXPECT_EQ(lanes_log2(splat(1))[0], 0); }

}  // namespace
}  // namespace waylight
