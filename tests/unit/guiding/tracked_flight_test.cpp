#include "libguide/guiding/tracked_flight.h"

#include "common/flight_cases.h"

namespace waylight {
namespace {

using testing::cloud;
using testing::FlightCase;
using testing::FlightFixture;
using testing::kThrough;
using testing::lumpy_grid;

// Thin enough that tracking would hardly ever try, usual, and a wall.
std::vector<FlightCase> clouds() {
  std::vector<FlightCase> cases;
  for (const int channels : {1, 3})
    for (const float scale : {0.05f, 5.0f, 40.0f})
      cases.push_back({"cloud of " + std::to_string(channels) + " x " + std::to_string(scale),
                       cloud(lumpy_grid(channels), scale)});
  return cases;
}

// At most 1 / share in one colour; roulette, which ends sweeps early, makes of one a little more,
// and three channels share the quarter.
TEST(TrackedFlight, WeightsAreUnbiasedAndBoundedByTheStandardShare) {
  for (const FlightCase& c : clouds()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    const float largest =
        testing::expect_unbiased_weights(TrackedFlight(space, {0.25f}), fixture, c);
    EXPECT_LE(largest, 14.0f) << c.name;
  }
}

TEST(TrackedFlight, ScattersInThinCloudsWhereTheLightIs) {
  const FlightFixture fixture({"thin cloud", cloud(lumpy_grid(), 0.05f)});
  const FlightSpace space = fixture.space();
  const TrackedFlight guided(space, {0.25f}), plain(space, {1});
  constexpr int kFlights = 4096;
  int more = 0, usual = 0;
  for (int i = 0; i < kFlights; ++i) {
    Sampler sampler(1, 2, i), same(1, 2, i);
    more += guided.sample(sampler).scattered;
    usual += plain.sample(same).scattered;
  }
  EXPECT_GT(more, 3 * usual);
}

TEST(TrackedFlight, PassesBesideTheGrid) {
  FlightFixture fixture({"cloud", cloud(lumpy_grid(), 100)});
  FlightSpace space = fixture.space(kInfinity);
  space.ray = {Vec3(-1, 2, 0), Vec3::UnitX()};
  Sampler sampler(1, 2, 3);
  const Flight flight = TrackedFlight(space, {0.25f}).sample(sampler);
  EXPECT_FALSE(flight.scattered);
  EXPECT_NEAR(flight.weight.x(), 1, 1e-5);
}

}  // namespace
}  // namespace waylight
