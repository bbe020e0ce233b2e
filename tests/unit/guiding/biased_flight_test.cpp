#include "libguide/guiding/biased_flight.h"

#include "common/flight_cases.h"

namespace waylight {
namespace {

using testing::flight_cases;
using testing::FlightCase;
using testing::FlightFixture;
using testing::homogeneous;
using testing::kEnd;

FlightOptions biased(float bias) {
  FlightOptions options;
  options.bias = bias;
  return options;
}

template <typename Check>
void for_each_flight(const Check& check) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    for (const float bias : {0.1f, 0.5f, 1.0f, 10.0f})
      check(BiasedFlight(space, biased(bias)), fixture, c);
  }
}

TEST(BiasedFlight, DensityAndChanceToPassSumToOne) {
  for_each_flight([](const auto& flight, const auto&, const FlightCase& c) {
    testing::expect_density_and_pass_sum_to_one(flight, c);
  });
}

TEST(BiasedFlight, SamplesFollowTheDensity) {
  for_each_flight([](const auto& flight, const auto&, const FlightCase& c) {
    testing::expect_samples_follow_density(flight, c);
  });
}

// Three channels share the standard half. In grids the block's mean stands for the density.
TEST(BiasedFlight, WeightsAreUnbiasedAndAtMostTwiceTheStandardOnes) {
  for_each_flight([](const auto& flight, const FlightFixture& fixture, const FlightCase& c) {
    const float largest = testing::expect_unbiased_weights(flight, fixture, c);
    EXPECT_LE(largest, fixture.medium.homogeneous() ? 6.01f : kInfinity) << c.name;
  });
}

TEST(BiasedFlight, GoesByBothExtinctions) {
  const FlightFixture fixture({"fog", homogeneous(Color::Constant(0.8f), Color::Ones())});
  const FlightSpace space = fixture.space();
  const BiasedFlight flight(space, biased(3));
  EXPECT_NEAR(flight.pass_prob(), 0.5f * (std::exp(-0.8f * kEnd) + std::exp(-2.4f * kEnd)), 1e-5f);
  EXPECT_NEAR(flight.pdf(0), 0.5f * (0.8f + 2.4f), 1e-5f);
}

}  // namespace
}  // namespace waylight
