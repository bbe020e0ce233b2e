#include "libguide/guiding/equiangular_flight.h"

#include "common/flight_cases.h"

namespace waylight {
namespace {

using testing::flight_cases;
using testing::FlightCase;
using testing::FlightFixture;
using testing::homogeneous;
using testing::kEnd;
using testing::kThrough;

// Beside the ray, behind its origin, far off, and on the ray.
std::vector<Vec3> lights() {
  return {kThrough(0.7f) + Vec3(0, 0.2f, 0),
          kThrough(-1) + Vec3(0, 0, 0.1f),
          {100, 300, -50},
          kThrough(1.2f)};
}

template <typename Check>
void for_each_flight(const Check& check) {
  for (const FlightCase& c : flight_cases()) {
    const FlightFixture fixture(c);
    if (!fixture.medium.homogeneous()) continue;
    const FlightSpace space = fixture.space();
    for (const Vec3& light : lights()) check(EquiangularFlight(space, light), fixture, c, light);
  }
}

bool on_ray(const Vec3& light) { return light == kThrough(1.2f); }

TEST(EquiangularFlight, DensityAndChanceToPassSumToOne) {
  for_each_flight([](const auto& flight, const auto&, const FlightCase& c, const Vec3& light) {
    if (!on_ray(light)) testing::expect_density_and_pass_sum_to_one(flight, c);
  });
}

TEST(EquiangularFlight, SamplesFollowTheDensity) {
  for_each_flight([](const auto& flight, const auto&, const FlightCase& c, const Vec3& light) {
    if (!on_ray(light)) testing::expect_samples_follow_density(flight, c);
  });
}

// Three channels share the standard half.
TEST(EquiangularFlight, WeightsAreUnbiasedAndAtMostTwiceTheStandardOnes) {
  for_each_flight([](const auto& flight, const auto& fixture, const FlightCase& c, const Vec3&) {
    EXPECT_LE(testing::expect_unbiased_weights(flight, fixture, c), 6.01f) << c.name;
  });
}

TEST(EquiangularFlight, ScattersNearTheLight) {
  const FlightFixture fixture({"thin fog", homogeneous(Color::Constant(1e-3f), Color::Ones())});
  const FlightSpace space = fixture.space();
  const EquiangularFlight flight(space, kThrough(0.7f) + Vec3(0, 0.02f, 0));
  EXPECT_GT(flight.pdf(0.7f), 5);
  EXPECT_LT(flight.pdf(2), 0.01f);
}

TEST(EquiangularFlight, HasFiniteWeightsOnRaysWithoutEnd) {
  for (const Color& sigma : {Color(0.1f, 1, 8), Color(0, 1, 2), Color(0, 0, 0)}) {
    const FlightFixture fixture({"endless fog", homogeneous(sigma, Color::Ones())});
    const FlightSpace space = fixture.space(kInfinity);
    for (const Vec3& light : lights()) {
      const EquiangularFlight flight(space, light);
      Color sum = Color::Zero();
      constexpr int kFlights = 1 << 14;
      for (int i = 0; i < kFlights; ++i) {
        Sampler sampler(5, 6, i);
        sum += flight.sample(sampler).weight / kFlights;
      }
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], 1, 0.04) << sigma.transpose();
    }
  }
}

TEST(EquiangularFlight, FindsPointsOfLampsAndNoneOfDistantLight) {
  const FlightFixture fixture({"fog", homogeneous(Color::Ones(), Color::Ones())});
  const FlightSpace space = fixture.space();
  Sampler sampler(1, 2, 3);
  SceneDescription sky = testing::box_of(fixture.media[0], {-1, -1, -1}, {1, 1, 1});
  sky.emitters.push_back(ConstantEnvironment{Color::Ones()});
  EXPECT_FALSE(light_point(Scene(std::move(sky)), space, sampler));
  SceneDescription lamp = testing::box_of(fixture.media[0], {-1, -1, -1}, {1, 1, 1});
  lamp.emitters.push_back(PointLight{Vec3(0.1f, 3, 0), Color::Ones()});
  const std::optional<Vec3> point = light_point(Scene(std::move(lamp)), space, sampler);
  ASSERT_TRUE(point);
  EXPECT_LT((*point - Vec3(0.1f, 3, 0)).norm(), 1e-4f);
}

}  // namespace
}  // namespace waylight
