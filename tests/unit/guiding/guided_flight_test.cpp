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

const Vec3 kBeside = kThrough(1.1f) + Vec3(0, 0.05f, 0);

// As they are, and in homogeneous media aimed at lights near, behind and far away.
template <typename Check>
void for_each_flight(const Check& check) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    const FlightSpace space = fixture.space();
    check(GuidedFlight(space, {0.25f}), fixture, c);
    if (!fixture.medium.homogeneous()) continue;
    for (const Vec3& light : {kBeside, Vec3(kThrough(-1) + Vec3(0, 0, 0.1f)), Vec3(90, 30, -50)}) {
      GuidedFlight aimed(space, {0.25f});
      aimed.aim_at(light);
      check(aimed, fixture, c);
    }
  }
}

TEST(GuidedFlight, DensityAndChanceToPassSumToOne) {
  for_each_flight([](const auto& flight, const auto&, const FlightCase& c) {
    testing::expect_density_and_pass_sum_to_one(flight, c);
  });
}

TEST(GuidedFlight, SamplesFollowTheDensity) {
  for_each_flight([](const auto& flight, const auto&, const FlightCase& c) {
    testing::expect_samples_follow_density(flight, c);
  });
}

// Three channels share the standard quarter. In grids the block's mean stands for the density.
TEST(GuidedFlight, WeightsAreUnbiasedAndBoundedByTheStandardShare) {
  for_each_flight([](const auto& flight, const FlightFixture& fixture, const FlightCase& c) {
    const float largest = testing::expect_unbiased_weights(flight, fixture, c);
    EXPECT_LE(largest, fixture.medium.homogeneous() ? 12.01f : kInfinity) << c.name;
  });
}

TEST(GuidedFlight, AimedAtALampOnlyWhereTheCellsHaveItsLight) {
  const FlightFixture fixture({"grey fog", homogeneous(Color::Constant(0.2f), Color::Ones())});
  const FlightSpace space = fixture.space();
  const GuidedFlight plain(space, {0.1f});
  GuidedFlight near(space, {0.1f}), far(space, {0.1f});
  near.aim_at(kBeside);
  far.aim_at(kThrough(1.1f) + Vec3(0, 500, 0));
  EXPECT_GT(plain.from_emitters(), 0.5f);
  EXPECT_GT(near.pdf(1.1f), 2 * plain.pdf(1.1f));
  EXPECT_NEAR(far.pdf(1.1f), plain.pdf(1.1f), 0.02f * plain.pdf(1.1f));

  FlightFixture dark({"grey fog", homogeneous(Color::Constant(0.2f), Color::Ones())});
  for (MediumCell& cell : dark.cache.cells) cell.direct = {};
  dark.guides = MediumGuides(MediumCacheView(dark.cache), dark.media);
  const FlightSpace dark_space = dark.space();
  GuidedFlight aimed(dark_space, {0.1f});
  const float before = aimed.pdf(1.1f);
  aimed.aim_at(kBeside);
  EXPECT_EQ(aimed.from_emitters(), 0);
  EXPECT_EQ(aimed.pdf(1.1f), before);
}

TEST(GuidedFlight, AimedAtALightOnTheRayOrAlongEndlessOnesIsFiniteAndUnbiased) {
  for (const Color& sigma : {Color(0.1f, 1, 8), Color(0, 1, 2), Color(0, 0, 0)})
    for (const float end : {kEnd, kInfinity})
      for (const Vec3& light : {kBeside, kThrough(1.2f), kThrough(-1)}) {
        const FlightFixture fixture({"fog", homogeneous(sigma, Color::Ones())});
        const FlightSpace space = fixture.space(end);
        GuidedFlight flight(space, {0.5f});
        flight.aim_at(light);
        Color sum = Color::Zero();
        constexpr int kFlights = 1 << 14;
        for (int i = 0; i < kFlights; ++i) {
          Sampler sampler(5, 6, i);
          sum += flight.sample(sampler).weight / kFlights;
        }
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], 1, 0.04) << sigma.transpose() << end;
      }
}

TEST(GuidedFlight, ScattersWhereTheLightIsAndPassesWhereItIsNot) {
  const FlightFixture fixture({"grey fog", homogeneous(Color::Constant(0.2f), Color::Ones())});
  const FlightSpace space = fixture.space();
  const GuidedFlight flight(space, {0.1f});
  const float at_shaft = 0.9f / kThrough.direction.x();                    // in the middle cell
  EXPECT_GT(flight.pdf(at_shaft), 3 * 0.2f * std::exp(-0.2f * at_shaft));  // of standard sampling
  EXPECT_GE(flight.pass_prob(), 0.1f * std::exp(-0.2f * kEnd));
}

}  // namespace
}  // namespace waylight
