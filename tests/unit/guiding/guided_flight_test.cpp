#include "libguide/guiding/guided_flight.h"

#include <gtest/gtest.h>

#include "common/small_media.h"

namespace waylight {
namespace {

using testing::cloud;
using testing::homogeneous;
using testing::lumpy_grid;

const Ray kThrough{Vec3(-0.5f, 0.41f, 0.38f), Vec3(0.9f, 0.12f, 0.2f).normalized()};
constexpr float kEnd = 2.5f;

// Three cells along x: light comes towards the ray's origin in the middle one, away from it in the
// last, and nothing is known of the first.
MediumCache cells_along_x() {
  MediumCache cache;
  cache.nodes = {
      {0.2f, 1, 0}, {0, 0, kLeafAxis}, {0.6f, 3, 0}, {0, 1, kLeafAxis}, {0, 2, kLeafAxis}};
  cache.components = {{1, Vec3::UnitX(), 20}, {1, -Vec3::UnitX(), 5}, {1, Vec3::UnitY(), 50}};
  MediumCell known;
  known.indirect = {0.3f, 1000, 1000, 0, 1};
  known.direct = {50, 1000, 1000, 2, 1};
  MediumCell last = known;
  last.indirect.first_component = 1;
  cache.cells = {MediumCell{}, known, last};
  return cache;
}

struct Case {
  const char* name;
  Medium medium;
};
std::vector<Case> cases() {
  return {{"grey fog", homogeneous(Color::Constant(0.8f), Color::Constant(0.9f), 0.5f)},
          {"coloured fog", homogeneous(Color(0.1f, 1, 8), Color::Constant(0.9f))},
          {"thin fog", homogeneous(Color::Constant(1e-4f), Color::Ones())},
          {"dense fog", homogeneous(Color::Constant(1e3f), Color::Ones(), 0.9f)},
          {"one colour missing", homogeneous(Color(0, 1, 2), Color::Ones())},
          {"cloud", cloud(lumpy_grid(), 5)},
          {"coloured cloud", cloud(lumpy_grid(3), 5)}};
}

// The flight of a case; `media` and the tracker must outlive it.
struct Fixture {
  explicit Fixture(const Case& c)
      : medium(c.medium), media{c.medium}, guides(MediumCacheView(cache), media) {}

  FlightSpace space(float end = kEnd, bool with_direct = false) const {
    return {medium, guides, 0, kThrough, end, Color::Constant(1.0f / 3), with_direct};
  }

  MediumCache cache = cells_along_x();
  MediumTracker medium;
  std::vector<Medium> media;
  MediumGuides guides;
};

TEST(GuidedFlight, DensityAndChanceToPassSumToOne) {
  for (const Case& c : cases()) {
    const Fixture fixture(c);
    const FlightSpace space = fixture.space();
    const GuidedFlight flight(space, {0.25f});
    double sum = flight.pass_prob();
    const bool dense = std::string(c.name) == "dense fog";
    const int steps = 20000;
    const double reach = dense ? 0.05 : kEnd;  // all of it scatters before
    for (int i = 0; i < steps; ++i)
      sum += flight.pdf(static_cast<float>((i + 0.5) / steps * reach)) * reach / steps;
    EXPECT_NEAR(sum, 1, 3e-3) << c.name;
  }
}

TEST(GuidedFlight, SamplesFollowTheDensity) {
  for (const Case& c : cases()) {
    const Fixture fixture(c);
    const FlightSpace space = fixture.space();
    const GuidedFlight flight(space, {0.25f});
    constexpr int kBins = 10, kFlights = 1 << 14;
    const float reach = std::string(c.name) == "dense fog" ? 5e-3f : kEnd;
    std::array<double, kBins + 1> counts{}, expected{};
    for (int i = 0; i < kFlights; ++i) {
      Sampler sampler(1, 2, i);
      const Flight f = flight.sample(sampler);
      const int bin = f.scattered ? std::min(static_cast<int>(f.t / reach * kBins), kBins) : kBins;
      counts[bin] += 1.0 / kFlights;
    }
    expected[kBins] = 1;
    for (int bin = 0; bin < kBins; ++bin) {
      for (int i = 0; i < 500; ++i)
        expected[bin] += flight.pdf((bin + (i + 0.5f) / 500) / kBins * reach) * reach / kBins / 500;
      expected[kBins] -= expected[bin];
    }
    for (int bin = 0; bin <= kBins; ++bin)
      EXPECT_NEAR(counts[bin], expected[bin], 0.015) << c.name << " bin " << bin;
  }
}

// Of T sigma_t over the ray, and T behind.
TEST(GuidedFlight, WeightsAreUnbiasedAndBoundedByTheStandardShare) {
  for (const Case& c : cases()) {
    const Fixture fixture(c);
    const FlightSpace space = fixture.space();
    const GuidedFlight flight(space, {0.25f});
    constexpr int kFlights = 1 << 16;
    Color scattered = Color::Zero(), passed = Color::Zero(), depth = Color::Zero();
    float largest = 0;
    for (int i = 0; i < kFlights; ++i) {
      Sampler sampler(3, 4, i);
      const Flight f = flight.sample(sampler);
      (f.scattered ? scattered : passed) += f.weight / kFlights;
      largest = std::max(largest, f.weight.maxCoeff());
    }
    for (int i = 0; i < 2000; ++i)
      depth += fixture.medium.at(kThrough((i + 0.5f) / 2000 * kEnd)).sigma_t * (kEnd / 2000);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(passed[k], std::exp(-depth[k]), 0.02) << c.name;
      EXPECT_NEAR(scattered[k], 1 - std::exp(-depth[k]), 0.02) << c.name;
    }
    // Three channels share the standard quarter. In grids the block's mean stands for the density.
    if (fixture.medium.homogeneous()) EXPECT_LE(largest, 12.01f) << c.name;
  }
}

TEST(GuidedFlight, ScattersWhereTheLightIsAndPassesWhereItIsNot) {
  const Fixture fixture({"grey fog", homogeneous(Color::Constant(0.2f), Color::Ones())});
  const FlightSpace space = fixture.space();
  const GuidedFlight flight(space, {0.1f});
  const float at_shaft = 0.9f / kThrough.direction.x();  // in the middle cell
  EXPECT_GT(flight.pdf(at_shaft), 3 * 0.2f * std::exp(-0.2f * at_shaft));  // of standard sampling
  EXPECT_GE(flight.pass_prob(), 0.1f * std::exp(-0.2f * kEnd));
}

}  // namespace
}  // namespace waylight
