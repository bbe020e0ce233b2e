#pragma once
// Flights through small media that a cache knows, and what holds for every way to sample them.

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "libguide/guiding/flight_space.h"

namespace waylight::testing {

inline const Ray kThrough{Vec3(-0.5f, 0.41f, 0.38f), Vec3(0.9f, 0.12f, 0.2f).normalized()};
inline constexpr float kEnd = 2.5f;

// Three cells along x: light comes towards the ray's origin in the middle one, away from it in the
// last, and nothing is known of the first.
inline MediumCache cells_along_x() {
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

struct FlightCase {
  std::string name;
  Medium medium;

  // How far one looks for scatterings; all of the dense fog's are within.
  double reach() const { return name == "dense fog" ? 0.1 : kEnd; }
};
inline std::vector<FlightCase> flight_cases() {
  return {{"grey fog", homogeneous(Color::Constant(0.8f), Color::Constant(0.9f), 0.5f)},
          {"coloured fog", homogeneous(Color(0.1f, 1, 8), Color::Constant(0.9f))},
          {"thin fog", homogeneous(Color::Constant(1e-4f), Color::Ones())},
          {"dense fog", homogeneous(Color::Constant(1e3f), Color::Ones(), 0.9f)},
          {"one colour missing", homogeneous(Color(0, 1, 2), Color::Ones())},
          {"cloud", cloud(lumpy_grid(), 5)},
          {"coloured cloud", cloud(lumpy_grid(3), 5)}};
}

// The flight of a case; `media` and the tracker must outlive it.
struct FlightFixture {
  explicit FlightFixture(const FlightCase& c)
      : medium(c.medium), media{c.medium}, guides(MediumCacheView(cache), media) {}

  FlightSpace space(float end = kEnd, bool with_direct = false) const {
    return {medium, guides, 0, kThrough, end, Color::Constant(1.0f / 3), with_direct};
  }

  MediumCache cache = cells_along_x();
  MediumTracker medium;
  std::vector<Medium> media;
  MediumGuides guides;
};

template <typename Sampling>
void expect_density_and_pass_sum_to_one(const Sampling& flight, const FlightCase& c) {
  constexpr int kSteps = 20000;
  const double step = c.reach() / kSteps;
  double sum = flight.pass_prob();
  for (int i = 0; i < kSteps; ++i) sum += flight.pdf(static_cast<float>((i + 0.5) * step)) * step;
  EXPECT_NEAR(sum, 1, 3e-3) << c.name;
}

template <typename Sampling>
void expect_samples_follow_density(const Sampling& flight, const FlightCase& c) {
  constexpr int kBins = 10, kFlights = 1 << 14, kSteps = 500;
  const float reach = c.name == "dense fog" ? 5e-3f : kEnd;
  std::array<double, kBins + 1> counts{}, expected{};
  for (int i = 0; i < kFlights; ++i) {
    Sampler sampler(1, 2, i);
    const Flight f = flight.sample(sampler);
    const int bin = f.scattered ? std::min(static_cast<int>(f.t / reach * kBins), kBins) : kBins;
    counts[bin] += 1.0 / kFlights;
  }
  expected[kBins] = 1;
  for (int bin = 0; bin < kBins; ++bin) {
    for (int i = 0; i < kSteps; ++i)
      expected[bin] +=
          flight.pdf((bin + (i + 0.5f) / kSteps) / kBins * reach) * reach / kBins / kSteps;
    expected[kBins] -= expected[bin];
  }
  for (int bin = 0; bin <= kBins; ++bin)
    EXPECT_NEAR(counts[bin], expected[bin], 0.015) << c.name << " bin " << bin;
}

// Of T sigma_t over the two halves of the ray, and T behind. Returns the largest weight.
template <typename Sampling>
float expect_unbiased_weights(const Sampling& flight, const FlightFixture& fixture,
                              const FlightCase& c) {
  constexpr int kFlights = 1 << 16, kSteps = 2000;
  std::array<Color, 3> mean, depth;
  mean.fill(Color::Zero()), depth.fill(Color::Zero());
  float largest = 0;
  for (int i = 0; i < kFlights; ++i) {
    Sampler sampler(3, 4, i);
    const Flight f = flight.sample(sampler);
    mean[!f.scattered ? 2 : f.t > kEnd / 2 ? 1 : 0] += f.weight / kFlights;
    largest = std::max(largest, f.weight.maxCoeff());
  }
  for (int i = 0; i < kSteps; ++i)
    depth[i < kSteps / 2 ? 0 : 1] +=
        fixture.medium.at(kThrough((i + 0.5f) / kSteps * kEnd)).sigma_t * (kEnd / kSteps);
  const Color near = (-depth[0]).exp(), through = (-depth[0] - depth[1]).exp();
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[0][k], 1 - near[k], 0.02) << c.name;
    EXPECT_NEAR(mean[1][k], near[k] - through[k], 0.02) << c.name;
    EXPECT_NEAR(mean[2][k], through[k], 0.02) << c.name;
  }
  return largest;
}

}  // namespace waylight::testing
