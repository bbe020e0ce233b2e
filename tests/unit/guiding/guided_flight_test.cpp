#include "libguide/guiding/guided_flight.h"

#include "common/flight_cases.h"

namespace waylight {
namespace {

using testing::flight_cases;
using testing::FlightCase;
using testing::FlightFixture;
using testing::homogeneous;
using testing::kEnd;
using testing::kThrough;

TEST(GuidedFlight, DensityAndChanceToPassSumToOne) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    testing::expect_density_and_pass_sum_to_one(GuidedFlight(space, {0.25f}), c);
  }
}

TEST(GuidedFlight, SamplesFollowTheDensity) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    testing::expect_samples_follow_density(GuidedFlight(space, {0.25f}), c);
  }
}

TEST(GuidedFlight, WeightsAreUnbiasedAndBoundedByTheStandardShare) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    const float largest =
        testing::expect_unbiased_weights(GuidedFlight(space, {0.25f}), fixture, c);
    // Three channels share the standard quarter. In grids the block's mean stands for the density.
    EXPECT_LE(largest, fixture.medium.homogeneous() ? 12.01f : kInfinity) << c.name;
  }
}

TEST(GuidedFlight, ScattersWhereTheLightIsAndPassesWhereItIsNot) {
  const FlightFixture fixture({"grey fog", homogeneous(Color::Constant(0.2f), Color::Ones())});
  const FlightSpace space = fixture.space();
  const GuidedFlight flight(space, {0.1f});
  const float at_shaft = 0.9f / kThrough.direction.x();  // in the middle cell
  EXPECT_GT(flight.pdf(at_shaft), 3 * 0.2f * std::exp(-0.2f * at_shaft));  // of standard sampling
  EXPECT_GE(flight.pass_prob(), 0.1f * std::exp(-0.2f * kEnd));
}

}  // namespace
}  // namespace waylight
