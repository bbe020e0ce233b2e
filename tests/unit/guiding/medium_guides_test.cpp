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

// As the flight cell at a point has it; negative where that is not known.
float scattered_at(const MediumGuides& guides, float x, int bin) {
  LeafSpan span;
  LeafWalk walk = guides.walk({Vec3(x, 0, 0), Vec3::UnitY()}, 1);
  EXPECT_TRUE(walk.next(span));
  return guides.scattered(0, span.cell, bin);
}

// Those of cells that are alike hold the mean of both.
TEST(MediumGuides, TablesHoldWhatTheCellsScatter) {
  const testing::FlightFixture fixture(testing::flight_cases()[0]);
  const MediumGuides& guides = fixture.guides;
  EXPECT_EQ(guides.flight_cells(), 2u);  // light straight from emitters makes two of three alike
  for (int i = 0; i < guides.bins(0).count(); ++i) {
    const Vec3 w = guides.bins(0).centre(i);
    EXPECT_LT(scattered_at(guides, 0.1f, i), 0);
    EXPECT_EQ(scattered_at(guides, 0.4f, i), scattered_at(guides, 0.8f, i));
    const float indirect =
        (guides.guide(0, 1).scattered_indirect(w) + guides.guide(0, 2).scattered_indirect(w)) / 2;
    EXPECT_GE(scattered_at(guides, 0.4f, i), indirect);
  }
}

TEST(MediumGuides, TablesOfCellsThatScatterOtherLightAreTheirOwn) {
  testing::FlightFixture fixture(testing::flight_cases()[0]);
  for (MediumCell& cell : fixture.cache.cells) cell.direct = {};
  const MediumGuides guides(MediumCacheView(fixture.cache), fixture.media);
  ASSERT_EQ(guides.flight_cells(), 3u);
  for (int i = 0; i < guides.bins(0).count(); ++i) {
    const Vec3 w = guides.bins(0).centre(i);
    EXPECT_EQ(scattered_at(guides, 0.4f, i), guides.guide(0, 1).scattered_indirect(w));
    EXPECT_EQ(scattered_at(guides, 0.8f, i), guides.guide(0, 2).scattered_indirect(w));
  }
}

}  // namespace
}  // namespace waylight
