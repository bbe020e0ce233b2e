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
        [&](const Vec3& w) { return phase_pdf(phase, forward.dot(w)); },
        DensityCheck{.tests = std::size(kCosines)});
  }
}

TEST(Phase, MeanCosineOfTheSamplesIsG) {
  for (const float g : {-0.99f, -0.5f, -1e-4f, 0.0f, 5e-4f, 2e-3f, 0.3f, 0.9f, 0.99f}) {
    double sum = 0;
    constexpr int kSamples = 1 << 16;
    for (int i = 0; i < kSamples; ++i) sum += sample_henyey_greenstein(g, (i + 0.5f) / kSamples);
    EXPECT_NEAR(sum / kSamples, g, 2e-4) << g;
  }
}

}  // namespace
}  // namespace waylight
