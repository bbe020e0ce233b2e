#include "libguide/math/distribution.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

const std::vector<float> kWeights{0, 3, 0, 0, 1, 4, 0};

TEST(Discrete, FrequenciesAreProportionalToWeights) {
  const Discrete table(kWeights);
  std::vector<int> counts(kWeights.size());
  constexpr int kCount = 8000;
  for (int i = 0; i < kCount; ++i) ++counts[table.sample((i + 0.5f) / kCount).index];
  for (size_t i = 0; i < kWeights.size(); ++i)
    EXPECT_NEAR(counts[i], kCount * kWeights[i] / 8, 1) << "index " << i;
}

TEST(Discrete, NeverSamplesWeightZeroAtTheEdgesOfItsCells) {
  const Discrete table(kWeights);
  for (const float u : {0.0f, 0.375f, std::nextafter(0.375f, 0.0f), 0.5f, kOneMinusEpsilon})
    EXPECT_GT(kWeights[table.sample(u).index], 0) << "u " << u;
}

TEST(Discrete, LeavesAUniformRandomNumber) {
  const Discrete table(kWeights);
  const Discrete::Sample s = table.sample(0.375f + 0.125f * 0.25f);
  EXPECT_EQ(s.index, 4);
  EXPECT_NEAR(s.u, 0.25f, 1e-5f);
  EXPECT_LT(table.sample(kOneMinusEpsilon).u, 1);
}

// At the steps of its table, beside them and between; weights of very different sizes, runs of
// zeros.
TEST(Discrete, SampleIsThatOfASearchThroughTheWholeTable) {
  std::vector<float> weights(1000);
  for (int i = 0; i < 1000; ++i)
    weights[i] = i % 7 < 2 || i > 990 ? 0 : std::exp(0.02f * static_cast<float>(i % 331));
  const Discrete table(weights);
  std::vector<float> numbers{0, kOneMinusEpsilon};
  for (int k = 1; k < 4096; ++k) {
    const float u = static_cast<float>(k) / 4096;
    numbers.insert(numbers.end(), {std::nextafter(u, 0.0f), u, std::nextafter(u, 1.0f)});
  }
  for (int i = 0; i < 1000; ++i)
    if (table.cdf(i) < 1) numbers.push_back(table.cdf(i));
  for (const float u : numbers) {
    int last = 0;
    for (int i = 0; i < 1000; ++i)
      if (table.cdf(i) <= u) last = i;
    ASSERT_EQ(table.sample(u).index, last) << u;
  }
}

TEST(Discrete, WithoutWeightIsEmpty) {
  EXPECT_TRUE(Discrete().empty());
  EXPECT_TRUE(Discrete(std::vector<float>{0, 0}).empty());
}

TEST(PiecewiseConstant1d, SamplesHaveTheDensityOfTheirCells) {
  const PiecewiseConstant1d density(kWeights);
  for (int i = 0; i < 1000; ++i) {
    const PiecewiseConstant1d::Sample s = density.sample((i + 0.5f) / 1000);
    EXPECT_FLOAT_EQ(s.pdf, 7 * kWeights[s.cell] / 8);
    EXPECT_GT(s.pdf, 0);
    EXPECT_NEAR(7 * s.x, s.cell + s.inside, 1e-5f);
  }
}

TEST(PiecewiseConstant2d, SamplesHaveTheDensityOfTheirCells) {
  const std::vector<float> weights{1, 0, 2, 0, 0, 0, 0, 5, 1};
  const PiecewiseConstant2d density(weights, 3, 3);
  std::vector<int> counts(9);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 90; ++x) {
      const PiecewiseConstant2d::Sample s = density.sample({(x + 0.5f) / 90, (y + 0.5f) / 90});
      EXPECT_NEAR(s.pdf, weights[3 * s.row + s.column], 1e-5f);  // of nine in all
      EXPECT_NEAR(s.pdf, 9 * density.cell_prob(s.column, s.row), 1e-5f);
      EXPECT_LT((3 * s.p - Vec2(s.column, s.row) - s.inside).norm(), 1e-5f);
      ++counts[3 * s.row + s.column];
    }
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(counts[i] / 900.0, weights[i], 0.05) << i;
}

}  // namespace
}  // namespace waylight
