// Radiance that media emit along rays.

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "libguide/medium/medium_tracker.h"

namespace waylight {
namespace {

using testing::cloud;
using testing::homogeneous;
using testing::lumpy_grid;

const Ray kThrough{Vec3(-0.5f, 0.41f, 0.38f), Vec3(0.9f, 0.12f, 0.2f).normalized()};
constexpr float kEnd = 2.5f;
const Color kRadiance(3, 2, 0.5f);

Medium glowing(Medium medium, const VolumeTexture& radiance = kRadiance,
               const Color& scale = Color::Ones()) {
  medium.emission = {radiance, scale};
  return medium;
}

// int T sigma_a Le dt by the midpoint rule.
Color quadrature(const MediumTracker& medium, const Ray& ray, float t_max) {
  constexpr int kSteps = 20000;
  const float step = t_max / kSteps;
  Color sum = Color::Zero(), depth = Color::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 p = ray((i + 0.5f) * step);
    const MediumCoefficients here = medium.at(p);
    const Color half = 0.5f * step * here.sigma_t;
    sum += (-(depth + half)).exp() * (1 - here.albedo) * here.sigma_t * medium.emitted_at(p) * step;
    depth += 2 * half;
  }
  return sum;
}

struct Estimates {
  Color mean = Color::Zero(), deviation = Color::Zero();  // of a single one
};

Estimates estimate(const MediumTracker& medium, const Ray& ray, float t_max, int count = 1 << 15) {
  Color sum = Color::Zero(), sum2 = Color::Zero();
  for (int i = 0; i < count; ++i) {
    Sampler sampler(1, 2, i);
    const Color emitted = medium.emission(ray, t_max, sampler);
    sum += emitted / count, sum2 += emitted.square() / count;
  }
  return {sum, (sum2 - sum.square()).max(0.0f).sqrt()};
}

void expect_unbiased(const Medium& description, const char* what) {
  constexpr int kCount = 1 << 15;
  const MediumTracker medium(description);
  const Color expected = quadrature(medium, kThrough, kEnd);
  const Estimates estimates = estimate(medium, kThrough, kEnd, kCount);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(estimates.mean[c], expected[c],
                4 * estimates.deviation[c] / std::sqrt(kCount) + 2e-3f * expected[c])
        << what << " channel " << c;
}

TEST(MediumEmission, OfAHomogeneousMediumIsExact) {
  const Color sigma(0.2f, 1, 30), albedo(0, 0.5f, 1);
  const MediumTracker medium(glowing(homogeneous(sigma, albedo)));
  Sampler sampler(1, 2, 3);
  const Color emitted = medium.emission(kThrough, 2, sampler);
  const Color expected = (1 - albedo) * kRadiance * (1 - (-2 * sigma).exp());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(emitted[c], expected[c], 1e-6f) << c;
  EXPECT_EQ(sampler.dimension(), Sampler(1, 2, 3).dimension());
}

TEST(MediumEmission, OfAThickMediumIsTheRadianceOfItsAbsorption) {
  const MediumTracker medium(glowing(homogeneous(Color(0, 1, 30), Color::Constant(0.25f))));
  Sampler sampler(1, 2, 3);
  const Color emitted = medium.emission(kThrough, kInfinity, sampler);
  EXPECT_EQ(emitted[0], 0);
  for (int c = 1; c < 3; ++c) EXPECT_NEAR(emitted[c], 0.75f * kRadiance[c], 1e-6f) << c;
}

TEST(MediumEmission, OfGridsIsUnbiased) {
  const Color scale(1, 0.4f, 0.1f);
  expect_unbiased(glowing(cloud(lumpy_grid(), 5, 0.6f)), "constant in a cloud");
  expect_unbiased(glowing(cloud(lumpy_grid(3), 5, 0.6f)), "constant in a coloured cloud");
  expect_unbiased(glowing(cloud(lumpy_grid(), 40, 0), lumpy_grid(), scale), "thick cloud");
  expect_unbiased(glowing(cloud(lumpy_grid(), 0.05f, 0), lumpy_grid(3)), "thin cloud");
  Medium even{"even", HeterogeneousMedium{Color(0.3f, 1, 2), Color(Color::Constant(0.2f)), 1.5f},
              IsotropicPhase{}};
  expect_unbiased(glowing(even, lumpy_grid(), scale), "a glow in even fog");
}

TEST(MediumEmission, OfAGridOfEqualVoxelsIsThatOfAHomogeneousMedium) {
  auto grid = std::make_shared<VolumeGrid>();
  grid->voxels = VoxelBricks(Eigen::Vector3i::Constant(4), 1, std::vector<float>(64, 0.5f));
  const Ray ray{Vec3(-1, 0.3f, 0.6f), Vec3::UnitX()};
  const MediumTracker varying(glowing(cloud(grid, 4, 0.3f)));
  const MediumTracker constant(glowing(homogeneous(Color::Constant(2), Color::Constant(0.3f))));
  const Estimates estimates = estimate(varying, ray, 5);
  Sampler sampler(1, 2, 3);
  const Color expected = constant.emission(ray, 1, sampler);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(estimates.mean[c], expected[c], 0.01f * expected[c]);
}

TEST(MediumEmission, AlongEndlessRaysEndsWhereAChannelHasNoExtinction) {
  Medium even{"even", HeterogeneousMedium{Color(0, 1, 2), Color(Color::Zero())}, IsotropicPhase{}};
  const MediumTracker medium(glowing(even, lumpy_grid()));
  const Color expected = quadrature(medium, kThrough, kEnd);
  const Estimates estimates = estimate(medium, kThrough, kInfinity);
  EXPECT_EQ(estimates.mean[0], 0);
  for (int c = 1; c < 3; ++c) EXPECT_NEAR(estimates.mean[c], expected[c], 0.02f * expected[c]) << c;
}

// Real collisions would make the deviation of one ray that of finding anything, 30 times the mean.
TEST(MediumEmission, OfThinGridsIsNotLeftToRareCollisions) {
  const MediumTracker thin(glowing(cloud(lumpy_grid(), 1e-3f, 0)));
  const Estimates estimates = estimate(thin, kThrough, kEnd);
  EXPECT_LT(estimates.deviation[0], estimates.mean[0]);
  EXPECT_GT(estimates.mean[0], 0);
}

TEST(MediumEmission, OfWhiteAndOfDarkMediaIsNone) {
  Sampler sampler(1, 2, 3);
  const MediumTracker dark(cloud(lumpy_grid(), 5, 0));
  EXPECT_FALSE(dark.emits());
  EXPECT_TRUE(is_black(dark.emission(kThrough, kEnd, sampler)));
  const MediumTracker white(glowing(cloud(lumpy_grid(), 5, 1)));
  EXPECT_TRUE(is_black(white.emission(kThrough, kEnd, sampler)));
}

}  // namespace
}  // namespace waylight
