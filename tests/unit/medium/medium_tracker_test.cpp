#include "libguide/medium/medium_tracker.h"

#include <gtest/gtest.h>

#include "common/small_media.h"

namespace waylight {
namespace {

using testing::cloud;
using testing::homogeneous;
using testing::lumpy_grid;

const Ray kThrough{Vec3(-0.5f, 0.41f, 0.38f), Vec3(0.9f, 0.12f, 0.2f).normalized()};
constexpr float kEnd = 2.5f;
constexpr int kFlights = 1 << 16;

// Optical depths up to t by the midpoint rule.
Color optical_depth(const MediumTracker& medium, const Ray& ray, float t) {
  constexpr int kSteps = 4000;
  Color sum = Color::Zero();
  for (int i = 0; i < kSteps; ++i) sum += medium.at(ray((i + 0.5f) / kSteps * t)).sigma_t;
  return sum * (t / kSteps);
}

// Whether flights estimate the integrals of T sigma_t over the two halves of the ray, and T behind.
void expect_unbiased_flights(const Medium& description, const Color& throughput) {
  const MediumTracker medium(description);
  const float middle = 1;
  Color first = Color::Zero(), second = Color::Zero(), passed = Color::Zero();
  for (int i = 0; i < kFlights; ++i) {
    Sampler sampler(1, 2, i);
    const Flight flight = medium.fly(kThrough, kEnd, throughput, sampler);
    (!flight.scattered ? passed : flight.t < middle ? first : second) += flight.weight / kFlights;
  }
  const Color at_middle = (-optical_depth(medium, kThrough, middle)).exp();
  const Color behind = (-optical_depth(medium, kThrough, kEnd)).exp();
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(first[c], 1 - at_middle[c], 6e-3) << c;
    EXPECT_NEAR(second[c], at_middle[c] - behind[c], 6e-3) << c;
    EXPECT_NEAR(passed[c], behind[c], 6e-3) << c;
  }
}

TEST(ChooseChannel, NeverTakesOneOfNoProbability) {
  EXPECT_EQ(choose_channel({0.3f, 0.7f - 6e-8f, 0}, 0.99999994f), 1);
  EXPECT_EQ(choose_channel({0, 1, 0}, 0), 1);
  EXPECT_EQ(choose_channel({0.25f, 0.25f, 0.5f}, 0.6f), 2);
}

TEST(MediumTracker, FlightsThroughGreyFogFollowBeerLambert) {
  expect_unbiased_flights(homogeneous(Color::Constant(0.8f), Color::Ones()), Color::Ones());
}

TEST(MediumTracker, FlightsThroughColouredFogAreUnbiasedInEveryChannel) {
  const Medium medium = homogeneous(Color(0.2f, 1, 3), Color::Ones());
  expect_unbiased_flights(medium, Color::Ones());
  expect_unbiased_flights(medium, Color(1, 0.2f, 0.1f));
  expect_unbiased_flights(homogeneous(Color(0, 1, 3), Color::Ones()), Color::Ones());
}

TEST(MediumTracker, FlightsThroughAGridAreUnbiased) {
  expect_unbiased_flights(cloud(lumpy_grid(), 4), Color::Ones());
  expect_unbiased_flights(cloud(lumpy_grid(3), 4), Color(1, 0.5f, 0.2f));
}

TEST(MediumTracker, WeightsAreOneInMediaOfOneColour) {
  for (const Medium& description :
       {homogeneous(Color::Constant(0.8f), Color::Ones()), cloud(lumpy_grid(), 4)}) {
    const MediumTracker medium(description);
    for (int i = 0; i < 100; ++i) {
      Sampler sampler(3, 4, i);
      const Flight flight = medium.fly(kThrough, kEnd, Color(1, 0.3f, 0.5f), sampler);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(flight.weight[c], 1, 1e-5);
    }
  }
}

TEST(MediumTracker, WeightsOfColouredFogAreBoundedByTheChannels) {
  const MediumTracker medium(homogeneous(Color(0.01f, 1, 30), Color::Ones()));
  for (int i = 0; i < 1000; ++i) {
    Sampler sampler(3, 4, i);
    const Flight flight = medium.fly(kThrough, kEnd, Color::Ones(), sampler);
    EXPECT_LE(flight.weight.maxCoeff(), 3.001f);
    EXPECT_TRUE(is_finite(flight.weight));
  }
}

TEST(MediumTracker, TransmittanceIsUnbiasedAndWithinZeroAndOne) {
  for (const int channels : {1, 3}) {
    const MediumTracker medium(cloud(lumpy_grid(channels), 6));
    const Color expected = (-optical_depth(medium, kThrough, kEnd)).exp();
    Color sum = Color::Zero();
    for (int i = 0; i < kFlights; ++i) {
      Sampler sampler(5, 6, i);
      RandomStream random(sampler);
      const Color t = medium.transmittance(kThrough, kEnd, random);
      EXPECT_GE(t.minCoeff(), 0);
      EXPECT_LE(t.maxCoeff(), 1.0001f);
      sum += t / kFlights;
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 4e-3) << channels;
  }
}

// Half a voxel around them holds nothing, for shadow rays and flights alike.
TEST(MediumTracker, AGridWhoseValuesStandOnItsSidesEndsThere) {
  auto grid = std::make_shared<VolumeGrid>();
  grid->voxels = VoxelBricks(Eigen::Vector3i::Constant(2), 1, std::vector<float>(8, 1.0f));
  grid->values_on_sides = true;
  const MediumTracker medium(cloud(grid, 1));
  const Ray through{Vec3(-2, 0.4f, 0.6f), Vec3::UnitX()};
  Sampler sampler(1, 1, 1);
  RandomStream random(sampler);
  EXPECT_NEAR(medium.transmittance(through, kInfinity, random).x(), std::exp(-1.0f), 1e-5f);
  EXPECT_EQ(medium.transmittance({Vec3(-2, -0.1f, 0.6f), Vec3::UnitX()}, kInfinity, random).x(), 1);
}

TEST(MediumTracker, ARayThatMissesTheGridPasses) {
  const MediumTracker medium(cloud(lumpy_grid(), 1000));
  const Ray beside{Vec3(-1, 2, 0), Vec3::UnitX()};
  Sampler sampler(1, 1, 1);
  EXPECT_FALSE(medium.fly(beside, kInfinity, Color::Ones(), sampler).scattered);
  RandomStream random(sampler);
  EXPECT_EQ(medium.transmittance(beside, kInfinity, random).x(), 1);
}

TEST(ExtinctionBlocks, BoundsHoldForEveryPointAlongEveryRay) {
  const auto grid = lumpy_grid(3, 37);
  const ExtinctionBlocks blocks(*grid, 2);
  const GridLookup lookup(grid);
  for (int i = 0; i < 200; ++i) {
    Sampler sampler(7, 8, i);
    const Vec3 from = 3 * square_to_sphere(sampler.next_2d()), to(sampler.next(), 0.5f, 0.3f);
    const Ray ray{from, (to - from).normalized()};
    BlockWalk walk(blocks, ray, 6);
    float last = 0;
    for (RayBlock block; walk.next(block);) {
      EXPECT_GE(block.t0, last);
      for (const float u : {0.01f, 0.5f, 0.99f}) {
        const Color value = 2 * lookup.color_at(ray(block.t0 + u * block.length()));
        EXPECT_LE(value.maxCoeff(), block.most * 1.0001f);
        EXPECT_GE(value.minCoeff(), block.least * 0.9999f);
      }
      last = block.t1;
    }
  }
}

TEST(ExtinctionBlocks, LeaveOutNothingButEmptySpace) {
  const auto grid = lumpy_grid(1, 37);
  const ExtinctionBlocks blocks(*grid, 1);
  const GridLookup lookup(grid);
  double walked = 0, all = 0;
  const Ray ray{Vec3(0.01f, 0.02f, 0.03f), Vec3(1, 1, 1).normalized()};
  for (int i = 0; i < 2000; ++i) all += lookup.at(ray(i * 1e-3f)) * 1e-3f;
  BlockWalk walk(blocks, ray, 2);
  for (RayBlock block; walk.next(block);)
    for (int i = 0; i < 100; ++i)
      walked += lookup.at(ray(block.t0 + (i + 0.5f) / 100 * block.length())) * block.length() / 100;
  EXPECT_NEAR(walked, all, 1e-3);
}

}  // namespace
}  // namespace waylight
