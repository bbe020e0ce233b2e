#include "libguide/cache/photon_sample.h"

#include <gtest/gtest.h>

#include <numeric>

namespace waylight {
namespace {

TEST(PhotonSample, KeepsAllOfAShortStreamInOrder) {
  PhotonSample<int> sample(100);
  for (int i = 0; i < 100; ++i) sample.add(i);
  std::vector<int> all(100);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sample.kept(), all);
  EXPECT_EQ(sample.seen(), 100);
}

// 1024 of 100,000: a tenth of the stream has 102 +- 10 of them.
TEST(PhotonSample, KeepsEveryPartOfALongStreamEquallyOften) {
  PhotonSample<int> sample(1024);
  for (int i = 0; i < 100'000; ++i) sample.add(i);
  ASSERT_EQ(sample.kept().size(), 1024u);
  EXPECT_EQ(sample.seen(), 100'000);
  int tenths[10] = {};
  for (const int i : sample.kept()) ++tenths[i / 10'000];
  for (const int count : tenths) EXPECT_NEAR(count, 102.4, 40);
}

}  // namespace
}  // namespace waylight
