#include "libguide/medium/phase.h"

#include <gtest/gtest.h>

#include "statistical/density_assertions.h"

namespace waylight {
namespace {

using testing::DensityCheck;
using testing::expect_valid_density;
using testing::Sphere;

const float kCosines[] = {-0.95f, -0.5f, -1e-4f, 0, 2e-3f, 0.3f, 0.9f};

TEST(Phase, SamplesFollowTheDensityForEveryMeanCosine) {
  const Vec3 forward = Vec3(0.3f, -0.5f, 0.7f).normalized();
  for (const float g : kCosines) {
    const PhaseFunction phase = HenyeyGreenstein{g};
    expect_valid_density(
        Sphere{}, "g " + std::to_string(g),
        [&](Sampler& s) { return std::optional<Vec3>(sample_phase(phase, forward, s.next_2d())); },
        [&](const Vec3& w) { return phase_pdf(phase, forward, w); },
        DensityCheck{.tests = std::size(kCosines)});
  }
}

TEST(Phase, MeanCosineOfTheSamplesIsG) {
  for (const float g : {-0.99f, -0.5f, -1e-4f, 0.0f, 5e-4f, 2e-3f, 0.3f, 0.9f, 0.99f}) {
    double sum = 0;
    constexpr int kSamples = 1 << 16;
    const PhaseFunction phase = HenyeyGreenstein{g};
    for (int i = 0; i < kSamples; ++i)
      sum += sample_phase(phase, Vec3::UnitZ(), {(i + 0.5f) / kSamples, 0.5f}).z();
    EXPECT_NEAR(sum / kSamples, g, 2e-4) << g;
  }
}

// Half of the samples are within the v of the median, whose closed form is in double precision.
TEST(Phase, HoldsForTheNarrowestPeaks) {
  for (const double g : {0.999, 0.9999, 0.99999, -0.9999}) {
    const PhaseFunction phase = HenyeyGreenstein{float(g)};
    const double a = std::abs(double(float(g))), r = (1 - a) * (1 + a);
    const double median = (r - (1 - a)) * (r + (1 - a)) / (2 * a);
    const Vec3 forward = Vec3(0.3f, -0.5f, 0.7f).normalized(), peak = g > 0 ? forward : -forward;
    const float density = phase_pdf(phase, forward, peak);
    EXPECT_NEAR(density * 4 * kPi * (1 - a) * (1 - a) / (1 + a), 1, 1e-3) << g;
    int within = 0;
    constexpr int kSamples = 1 << 14;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 wi = sample_phase(phase, forward, {(i + 0.5f) / kSamples, 0.618f * (i % 1024)});
      ASSERT_TRUE(std::isfinite(phase_pdf(phase, forward, wi)));
      ASSERT_GT(phase_pdf(phase, forward, wi), 0);
      within += 0.5 * (wi - peak).squaredNorm() < median;
    }
    EXPECT_NEAR(within, kSamples / 2, kSamples / 50) << g;
  }
}

}  // namespace
}  // namespace waylight
