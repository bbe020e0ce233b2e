#include "libguide/math/fast_exp.h"

#include <gtest/gtest.h>

#include <limits>

namespace waylight {
namespace {

TEST(FastExp, RelativeErrorOfExpIsBelowOneInAMillion) {
  double worst = 0;
  for (double x = -80; x < 80; x += 0.00037) {
    const float argument = static_cast<float>(x);
    const double exact = std::exp(static_cast<double>(argument));
    worst = std::max(worst, std::abs(exp_clamped(splat(argument))[3] / exact - 1));
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(FastExp, RelativeErrorOfExp2IsBelowThreeInTenMillion) {
  double worst = 0;
  for (double x = -115; x < 115; x += 0.00053) {
    const float argument = static_cast<float>(x);
    const double exact = std::exp2(static_cast<double>(argument));
    worst = std::max(worst, std::abs(exp2_clamped(splat(argument))[6] / exact - 1));
  }
  EXPECT_LT(worst, 3e-7);
}

TEST(FastExp, ClampsBelowAndSwallowsNaN) {
  const float lowest = exp_clamped(splat(kMinExponent))[0];
  EXPECT_GT(lowest, std::numeric_limits<float>::min());
  for (float x : {-81.0f, -1e30f, -std::numeric_limits<float>::infinity(), std::nanf("")})
    EXPECT_EQ(exp_clamped(splat(x))[0], lowest) << x;
}

TEST(Lanes, PrefixSumAndReductionsAgreeWithLoops) {
  const Lanes v = {1, 2, 4, 8, 16, 32, 64, 128};
  const Lanes prefix = lanes_prefix_sum(v);
  for (int i = 0; i < kLanes; ++i) EXPECT_EQ(prefix[i], (2 << i) - 1);
  EXPECT_EQ(lanes_sum(v), 255);
  EXPECT_EQ(lanes_sum_splat(v)[5], 255);
  for (int i = 0; i < kLanes; ++i) EXPECT_EQ(lanes_count(prefix <= prefix[i]), i + 1);
}

TEST(Lanes, DifferenceOfProductsSurvivesCancellation) {
  const float a = 0.3f, b = 0.7f, c = 0.3f + 1e-7f, d = 0.7f - 2e-7f;
  const double exact = static_cast<double>(a) * b - static_cast<double>(c) * d;
  ASSERT_NE(exact, 0);
  const Lanes result = difference_of_products(splat(a), splat(b), splat(c), splat(d));
  EXPECT_NEAR(result[0], exact, 1e-6 * std::abs(exact));
}

}  // namespace
}  // namespace waylight
