#include "libguide/guiding/probability_flight.h"

#include "common/flight_cases.h"
#include "libguide/guiding/guided_flight.h"

namespace waylight {
namespace {

using testing::flight_cases;
using testing::FlightCase;
using testing::FlightFixture;
using testing::homogeneous;
using testing::kEnd;
using testing::kThrough;

TEST(ProbabilityFlight, DensityAndChanceToPassSumToOneInFog) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    if (!fixture.medium.homogeneous()) continue;
    const FlightSpace space = fixture.space();
    testing::expect_density_and_pass_sum_to_one(ProbabilityFlight(space, {0.25f}), c);
  }
}

TEST(ProbabilityFlight, SamplesFollowTheDensityInFog) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    if (!fixture.medium.homogeneous()) continue;
    const FlightSpace space = fixture.space();
    testing::expect_samples_follow_density(ProbabilityFlight(space, {0.25f}), c);
  }
}

// Three channels share the standard quarter, in grids too; there roulette ends sweeps early, which
// makes of one a little more.
TEST(ProbabilityFlight, WeightsAreUnbiasedAndBoundedByTheStandardShare) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    const ProbabilityFlight flight(space, {0.25f});
    const float largest = testing::expect_unbiased_weights(flight, fixture, c);
    EXPECT_LE(largest, fixture.medium.homogeneous() ? 12.01f : 13.0f) << c.name;
  }
}

// Behind a wall of cloud nothing is left but roulette's survivors.
TEST(ProbabilityFlight, IsUnbiasedInDenseClouds) {
  for (const int channels : {1, 3}) {
    const FlightCase c{"dense cloud", testing::cloud(testing::lumpy_grid(channels), 40)};
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    testing::expect_unbiased_weights(ProbabilityFlight(space, {0.25f}), fixture, c);
  }
}

TEST(ProbabilityFlight, PassesWhereThereIsNothingAndNeverThroughAWall) {
  Sampler sampler(1, 2, 3);
  const FlightFixture nothing({"nothing", homogeneous(Color::Zero(), Color::Ones())});
  const FlightSpace empty = nothing.space(kInfinity);
  const Flight passed = ProbabilityFlight(empty, {0.25f}).sample(sampler);
  EXPECT_FALSE(passed.scattered);
  EXPECT_TRUE((passed.weight == 1).all());
  const FlightFixture wall({"wall", homogeneous(Color::Constant(1e6f), Color::Ones())});
  const FlightSpace dense = wall.space();
  const Flight stopped = ProbabilityFlight(dense, {0.25f}).sample(sampler);
  EXPECT_TRUE(stopped.scattered);
  EXPECT_TRUE((stopped.weight.isApproxToConstant(1, 1e-4f)));
}

TEST(ProbabilityFlight, ScattersAsOftenAsTheGuideSays) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    if (!fixture.medium.homogeneous()) continue;
    const FlightSpace space = fixture.space();
    const float share = 0.25f;
    const double standard = (space.channels * (-fixture.medium.at({}).sigma_t * kEnd).exp()).sum();
    const double guided = GuidedFlight(space, {1e-6f}).pass_prob();
    EXPECT_NEAR(ProbabilityFlight(space, {share}).pass_prob(),
                share * standard + (1 - share) * guided, 1e-3)
        << c.name;
  }
}

}  // namespace
}  // namespace waylight
