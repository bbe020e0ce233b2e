#include "libguide/guiding/medium_guides.h"

#include <gtest/gtest.h>

#include "common/flight_cases.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

TEST(Octahedral, ThereAndBackIsTheSameDirection) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3 w = square_to_sphere({(i + 0.5f) / 1000, std::fmod(i * 0.618f, 1.0f)});
    EXPECT_LT((octahedral_to_direction(direction_to_octahedral(w)) - w).norm(), 1e-6f);
  }
}

TEST(ScatteredBins, EachHoldsItsCentreAndDirectionsNearIt) {
  for (const auto& [g, degrees] : {std::pair{0.0f, 180}, {0.5f, 32}, {-0.9f, 16}}) {
    const ScatteredBins bins(g);
    for (int i = 0; i < bins.count(); ++i) EXPECT_EQ(bins.of(bins.centre(i)), i);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 w = square_to_sphere({(i + 0.5f) / 1000, std::fmod(i * 0.618f, 1.0f)});
      EXPECT_GE(bins.centre(bins.of(w)).dot(w), std::cos(degrees * kPi / 180));
    }
  }
}

TEST(MediumGuides, TablesHoldWhatTheCellsScatter) {
  const testing::FlightFixture fixture(testing::flight_cases()[0]);
  const MediumGuides& guides = fixture.guides;
  int known = 0;
  for (uint32_t cell = 0; cell < fixture.cache.cells.size(); ++cell)
    for (int i = 0; i < guides.bins(0).count(); ++i) {
      const MediumGuide& guide = guides.guide(0, cell);
      const float scattered = guides.scattered(0, cell, i);
      EXPECT_EQ(scattered >= 0, guide.known());
      if (!guide.known()) continue;
      // Light straight from emitters comes on top.
      EXPECT_GE(scattered, guide.scattered_indirect(guides.bins(0).centre(i)));
      ++known;
    }
  EXPECT_GT(known, 0);
}

}  // namespace
}  // namespace waylight
