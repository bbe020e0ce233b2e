#include "libguide/base/sampler.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace waylight {
namespace {

TEST(Sampler, OneDimensionIsStratifiedAtEveryPowerOfTwo) {
  for (uint64_t stream : {0ull, 1ull, 77ull, 123456789ull})
    for (int log_n = 0; log_n <= 10; ++log_n) {
      const int n = 1 << log_n;
      std::vector<int> hits(n);
      for (int i = 0; i < n; ++i) ++hits[static_cast<int>(Sampler(3, stream, i).next() * n)];
      for (int hit : hits) ASSERT_EQ(hit, 1) << "n = " << n << ", stream " << stream;
    }
}

// A (0,2)-net: each of the 2^a x 2^b elementary intervals of area 1/n holds exactly one point.
void expect_net(const std::vector<Vec2>& points, int log_n) {
  for (int a = 0; a <= log_n; ++a) {
    const int columns = 1 << a, rows = 1 << (log_n - a);
    std::vector<int> hits(points.size());
    for (const Vec2& p : points)
      ++hits[static_cast<int>(p.x() * columns) * rows + static_cast<int>(p.y() * rows)];
    for (int hit : hits) ASSERT_EQ(hit, 1) << columns << " x " << rows;
  }
}

TEST(Sampler, PairsFormNetsInEveryDimensionPair) {
  for (uint64_t stream : {0ull, 1ull, 4096ull})
    for (int log_n = 0; log_n <= 10; ++log_n) {
      std::vector<std::vector<Vec2>> dimensions(5);
      for (int i = 0; i < 1 << log_n; ++i) {
        Sampler sampler(9, stream, i);
        for (std::vector<Vec2>& points : dimensions) points.push_back(sampler.next_2d());
      }
      for (const std::vector<Vec2>& points : dimensions) expect_net(points, log_n);
    }
}

TEST(Sampler, AlignedBlocksAreNetsToo) {
  std::vector<Vec2> points;
  for (int i = 768; i < 1024; ++i) points.push_back(Sampler(9, 2, i).next_2d());
  expect_net(points, 8);
}

TEST(Sampler, DimensionsAreUncorrelated) {
  constexpr int n = 4096;
  std::vector<std::array<float, 6>> values(n);
  for (int i = 0; i < n; ++i) {
    Sampler sampler(4, 5, i);
    for (float& v : values[i]) v = sampler.next() - 0.5f;
  }
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < a; ++b) {
      double covariance = 0;
      for (const auto& v : values) covariance += v[a] * v[b] / double(n);
      // Independent: a standard deviation of 1/12/sqrt(n) = 0.0013.
      EXPECT_NEAR(covariance, 0, 5 * 0.0013) << a << " " << b;
    }
}

TEST(Sampler, StreamsAndSeedsDiffer) {
  std::set<float> values;
  for (uint64_t seed = 0; seed < 8; ++seed)
    for (uint64_t stream = 0; stream < 128; ++stream)
      values.insert(Sampler(seed, stream, 0).next());
  EXPECT_GE(values.size(), 1023u);  // of 2^24 values, 1024 draws collide with odds of 3 %
}

TEST(Sampler, StreamsAreUniformAtTheSameIndex) {
  for (uint32_t index : {0u, 1u, 1000u}) {
    Vec2 mean = Vec2::Zero();
    for (int stream = 0; stream < 16384; ++stream)
      mean += Sampler(1, stream, index).next_2d() / 16384;
    EXPECT_NEAR(mean.x(), 0.5, 5 * 0.289 / 128) << index;
    EXPECT_NEAR(mean.y(), 0.5, 5 * 0.289 / 128) << index;
  }
}

TEST(Sampler, ValuesAreBelowOneAndDimensionsCounted) {
  for (uint32_t i = 0; i < 100000; ++i) {
    Sampler sampler(1, i, ~i);
    const Vec2 p = sampler.next_2d();
    ASSERT_GE(p.minCoeff(), 0);
    ASSERT_LT(p.maxCoeff(), 1);
    ASSERT_EQ(sampler.dimension(), 2u);
  }
}

// Any change of these changes every image of the same seed.
TEST(Sampler, GoldenValues) {
  Sampler sampler(1, 2, 3);
  const float expected[6] = {0x1.da8a9p-1f,  0x1.e320f4p-1f, 0x1.14a09p-3f,
                             0x1.7bd276p-1f, 0x1.e8e17p-4f,  0x1.559c3cp-1f};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(sampler.next(), expected[i]) << i;
  const Vec2 pair = sampler.next_2d();
  EXPECT_EQ(pair.x(), expected[3]);
  EXPECT_EQ(pair.y(), expected[4]);
  EXPECT_EQ(sampler.next(), expected[5]);
}

TEST(Sampler, CopyForksTheSequence) {
  Sampler first(1, 2, 3);
  first.next();
  Sampler second = first;
  EXPECT_EQ(first.next_2d(), second.next_2d());
}

}  // namespace
}  // namespace waylight
