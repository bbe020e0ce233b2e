#include "libguide/transport/weight_window.h"

#include <gtest/gtest.h>

#include <limits>

namespace waylight {
namespace {

constexpr int kSteps = 1000;

// Mean over u of copies * weight.
double mean_weight(const WeightWindow& window, float q, int max_copies) {
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Population p = window.decide(q, max_copies, (i + 0.5f) / kSteps);
    sum += double(p.copies) * p.weight / kSteps;
  }
  return sum;
}

TEST(WeightWindow, KeepsTheMeanWeightWhateverTheEstimateSays) {
  for (const float q : {0.0f, 1e-30f, 0.01f, 0.2f, 0.333f, 0.334f, 1.0f, 1.66f, 1.7f, 2.3f, 19.5f,
                        1e6f, std::numeric_limits<float>::infinity()})
    for (const int max_copies : {1, 2, 3, 20})
      for (const float ratio : {1.0f, 5.0f, 1000.0f})
        EXPECT_NEAR(mean_weight(WeightWindow(ratio), q, max_copies), 1, 0.011)
            << "q " << q << ", " << max_copies << " copies, ratio " << ratio;
}

TEST(WeightWindow, EndsPathsBelowAndSplitsThemAboveNotTheOtherWayRound) {
  EXPECT_EQ(WeightWindow().decide(0.05f, 20, 0.99f).copies, 0);
  EXPECT_EQ(WeightWindow().decide(0.05f, 20, 0.01f).copies, 1);
  EXPECT_GT(WeightWindow().decide(0.05f, 20, 0.01f).weight, 1);
  EXPECT_GE(WeightWindow().decide(10, 20, 0.99f).copies, 2);
  EXPECT_LT(WeightWindow().decide(10, 20, 0.99f).weight, 1);
}

TEST(WeightWindow, LeavesPathsInsideAlone) {
  for (const float q : {0.34f, 1.0f, 1.66f, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_FALSE(WeightWindow().leaves(q, 20));
    EXPECT_EQ(WeightWindow().decide(q, 20, 0.99f).copies, 1);
    EXPECT_EQ(WeightWindow().decide(q, 20, 0.99f).weight, 1);
  }
}

TEST(WeightWindow, NeverMakesMoreCopiesThanThereIsRoomFor) {
  for (const int max_copies : {1, 2, 7, 20})
    for (const float q : {1.7f, 5.0f, 1e9f, std::numeric_limits<float>::infinity()})
      for (int i = 0; i < kSteps; ++i)
        ASSERT_LE(WeightWindow().decide(q, max_copies, (i + 0.5f) / kSteps).copies, max_copies);
}

TEST(WeightWindow, MovesWeightsToTheNearerEnd) {
  for (const float q : {0.1f, 0.3f}) {
    const Population p = WeightWindow().decide(q, 20, 0);
    EXPECT_NEAR(q * p.weight, WeightWindow().low(), 1e-6);
  }
  for (const float q : {2.0f, 7.0f, 30.0f}) {
    const Population p = WeightWindow().decide(q, 20, 0);
    EXPECT_NEAR(q * p.weight, WeightWindow().high(), 1e-5);
  }
}

}  // namespace
}  // namespace waylight
