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

TEST(PiecewiseConstant1d, DensityIntegratesToOneAndMatchesSamples) {
  const PiecewiseConstant1d density(kWeights);
  double integral = 0;
  for (int i = 0; i < 7000; ++i) integral += density.pdf((i + 0.5f) / 7000) / 7000;
  EXPECT_NEAR(integral, 1, 1e-5);
  for (int i = 0; i < 1000; ++i) {
    const PiecewiseConstant1d::Sample s = density.sample((i + 0.5f) / 1000);
    EXPECT_FLOAT_EQ(s.pdf, density.pdf(s.x));
    EXPECT_GT(s.pdf, 0);
  }
}

TEST(PiecewiseConstant1d, InvertUndoesSample) {
  const PiecewiseConstant1d density(kWeights);
  for (int i = 0; i < 1000; ++i) {
    const float u = (i + 0.5f) / 1000;
    EXPECT_NEAR(density.invert(density.sample(u).x), u, 1e-5f);
  }
}

TEST(PiecewiseConstant2d, DensityIntegratesToOneWithEmptyRowsAndColumns) {
  const std::vector<float> weights{1, 0, 2, 0, 0, 0, 0, 5, 1};
  const PiecewiseConstant2d density(weights, 3, 3);
  double integral = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x)
      integral += density.pdf({(x + 0.5f) / 300, (y + 0.5f) / 300}) / 90000;
  EXPECT_NEAR(integral, 1, 1e-5);
}

TEST(PiecewiseConstant2d, InvertUndoesSampleAndPdfAgrees) {
  const std::vector<float> weights{1, 0, 2, 0, 0, 0, 0, 5, 1};
  const PiecewiseConstant2d density(weights, 3, 3);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x) {
      const Vec2 u((x + 0.5f) / 50, (y + 0.5f) / 50);
      const PiecewiseConstant2d::Sample s = density.sample(u);
      EXPECT_FLOAT_EQ(s.pdf, density.pdf(s.p));
      EXPECT_NEAR(s.pdf, 9 * density.cell_prob(s.column, s.row), 1e-5f);
      EXPECT_LT((density.invert(s.p) - u).norm(), 1e-4f);
    }
}

}  // namespace
}  // namespace waylight
