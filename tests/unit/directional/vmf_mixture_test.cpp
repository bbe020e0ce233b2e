#include "libguide/directional/vmf_mixture.h"

#include <gtest/gtest.h>

#include "statistical/density_assertions.h"
#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

using test::random_direction;
using test::random_lobes;
using testing::DensityCheck;
using testing::expect_valid_density;
using testing::integrate_density;
using testing::Sphere;

const float kKappas[] = {0, 1e-30f, 1e-8f, 1e-4f, 0.1f, 1, 2.5f, 30, 1e3f, kMaxKappa};

// The cap about the pole that holds all but e^-72 of a lobe: quadrature of the whole sphere would
// miss narrow ones.
struct Cap : Sphere {
  double angle;
  explicit Cap(double kappa) : angle(std::min(std::numbers::pi, 12 / std::sqrt(kappa + 1e-9))) {}
  std::vector<testing::Box> roots() const {
    return {{{0, -std::numbers::pi}, {angle, std::numbers::pi}}};
  }
};

TEST(VmfLobe, DensityIntegratesToOneForEveryConcentration) {
  const Vec3 pole(0, 0, 1);
  for (float kappa : kKappas) {
    const Cap cap(kappa);
    const auto pdf = [&](const Vec3& w) { return vmf_pdf(pole, kappa, w); };
    const auto mixture_pdf = [&](const Vec3& w) {
      return VmfMixture(std::array{VmfComponent{1, pole, kappa}}).pdf(w);
    };
    EXPECT_NEAR(integrate_density(cap, pdf, 1e-8), 1, 1e-5) << kappa;
    EXPECT_NEAR(integrate_density(cap, mixture_pdf, 1e-8), 1, 1e-5) << kappa;
  }
}

TEST(VmfLobe, SamplesFollowTheDensity) {
  const Vec3 mean = Vec3(0.3f, -0.5f, -0.7f).normalized();
  for (float kappa : {0.0f, 1e-6f, 1.0f, 50.0f, 1e4f, kMaxKappa})
    expect_valid_density(
        Sphere{}, "kappa " + std::to_string(kappa),
        [&](Sampler& s) { return std::optional<Vec3>(sample_vmf(mean, kappa, s.next_2d())); },
        [&](const Vec3& w) { return vmf_pdf(mean, kappa, w); }, DensityCheck{.tests = 10});
}

TEST(VmfLobe, TheInverseUndoesTheWarp) {
  const Vec3 mean = Vec3(0.3f, -0.5f, 0.7f).normalized();
  for (float kappa : kKappas)
    for (int i = 0; i < 500; ++i) {
      const Vec2 u = Sampler(1, 0, i).next_2d();
      const Vec3 w = sample_vmf(mean, kappa, u);
      EXPECT_NEAR(w.norm(), 1, 1e-6);
      if (u.x() < 0.01f || u.x() > 0.99f) continue;  // the azimuth has lost its digits at the poles
      const Vec2 back = vmf_to_square(mean, kappa, w);
      const float tolerance = kappa > 100 ? 2e-3f : 1e-4f;
      EXPECT_NEAR(back.x(), u.x(), tolerance) << kappa;
      const float turn = std::abs(back.y() - u.y());
      EXPECT_LT(std::min(turn, 1 - turn), tolerance) << kappa;
    }
}

TEST(VmfLobe, EveryPointOfTheSquareGivesAUnitDirectionOfPositiveDensity) {
  for (float kappa : kKappas)
    for (float u : {0.0f, 1e-30f, 0.5f, kOneMinusEpsilon}) {
      const Vec3 w = sample_vmf(Vec3::UnitX(), kappa, {u, 0.3f});
      EXPECT_NEAR(w.norm(), 1, 1e-6) << kappa << " " << u;
      EXPECT_GT(vmf_pdf(Vec3::UnitX(), kappa, w), 1e-9f * vmf_norm(kappa)) << kappa << " " << u;
    }
}

TEST(VmfLobe, MeanCosineIsThatOfTheDensity) {
  for (double kappa : {1e-9, 1e-4, 0.05, 0.0999999, 0.1000001, 1.0, 10.0, 1e3, 1e5}) {
    double mean = 0, total = 0;  // over d = 1 - cos on a scale that follows the lobe
    const double top = std::min(2.0, 40 / kappa);
    for (int i = 0; i < 20000; ++i) {
      const double d = top * (i + 0.5) / 20000, f = std::exp(-kappa * d);
      mean += f * d, total += f;
    }
    EXPECT_NEAR((1 - mean_cosine(kappa)) / (mean / total), 1, 1e-5) << kappa;
  }
  EXPECT_NEAR(mean_cosine(1e-9) / (1e-9 / 3), 1, 1e-12);
  EXPECT_EQ(mean_cosine(0), 0);
}

TEST(VmfLobe, KappaOfMeanCosineIsItsInverseWithinItsBound) {
  for (int i = 0; i <= 10000; ++i) {
    const double r = 0.99999 * i / 10000, kappa = kappa_of_mean_cosine(r);
    if (r > 0) {
      EXPECT_NEAR(mean_cosine(kappa) / r, 1, 1e-9) << r;
    }
  }
  for (double kappa = 1e-6; kappa < kMaxKappa; kappa *= 1.1)
    EXPECT_NEAR(kappa_of_mean_cosine(mean_cosine(kappa)) / kappa, 1, 1e-6) << kappa;
  for (double r : {-1.0, 0.0, std::nan("")}) EXPECT_EQ(kappa_of_mean_cosine(r), 0);
  for (double r : {1 - 1e-7, 1.0, 2.0, HUGE_VAL}) EXPECT_EQ(kappa_of_mean_cosine(r), kMaxKappa);
}

TEST(VmfLanes, AreWithinTheirBoundsOfTheScalars) {
  EXPECT_EQ(lanes_vmf_norm(Lanes{})[0], kSpherePdf);
  EXPECT_EQ(lanes_dispersion(Lanes{})[0], 1);
  EXPECT_EQ(lanes_kappa_of_dispersion(splat(1))[0], 0);
  for (double kappa = 1e-6; kappa < kMaxKappa; kappa *= 1.02) {
    const double norm = kappa / (2 * std::numbers::pi * -std::expm1(-2 * kappa));
    const Lanes k = splat(static_cast<float>(kappa));
    EXPECT_NEAR(lanes_vmf_norm(k)[3] / norm, 1, 3e-6) << kappa;
    const double dispersion = 1 - mean_cosine(kappa);
    EXPECT_NEAR(lanes_dispersion(k)[5] / dispersion, 1, 1e-5) << kappa;
    const Lanes d = splat(static_cast<float>(dispersion));
    if (kappa > 1e-2) {  // below, 1 - A has lost them
      EXPECT_NEAR(lanes_kappa_of_dispersion(d)[7] / kappa, 1, 3e-4) << kappa;
    }
  }
}

TEST(VmfMixture, DensityIsTheSumOfItsLobes) {
  for (float narrow : {300.0f, kMaxKappa}) {
    const auto lobes = random_lobes(8, 1, narrow);
    const VmfMixture mixture(lobes);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 w = i % 2 ? random_direction(2, i)
                           : mixture.sample(0.1f * (i % 10), Sampler(3, 0, i).next_2d());
      const double expected = test::density(lobes, w);
      EXPECT_NEAR(mixture.pdf(w), expected, 3e-4 * expected + 1e-9);
    }
  }
}

TEST(VmfMixture, SamplesFollowTheDensity) {
  for (int count : {1, 3, 8}) {
    const VmfMixture mixture(random_lobes(count, 20 + count, 1e4f));
    expect_valid_density(
        Sphere{}, std::to_string(count) + " lobes",
        [&](Sampler& s) {
          const float u = s.next();
          return std::optional<Vec3>(mixture.sample(u, s.next_2d()));
        },
        [&](const Vec3& w) { return mixture.pdf(w); }, DensityCheck{.tests = 10});
  }
}

TEST(VmfMixture, LeavesOutWhatIsNotALobe) {
  const float nan = std::nanf("");
  const VmfComponent good = {2, Vec3::UnitX(), 5};
  std::vector<VmfComponent> bad(10, good);
  bad[0].weight = 0, bad[1].weight = -1, bad[2].weight = kInfinity, bad[3].weight = nan;
  bad[4].mean.x() = nan, bad[5].mean *= 0.9f, bad[6].mean.setZero();
  bad[7].kappa = -1, bad[8].kappa = nan, bad[9].kappa = kInfinity;
  const VmfMixture none(bad);
  EXPECT_EQ(none.count(), 0);
  bad.push_back(good);
  const VmfMixture one(bad);
  ASSERT_EQ(one.count(), 1);
  EXPECT_EQ(one.component(0).weight, 1);
  EXPECT_NEAR(one.pdf(Vec3::UnitX()), test::density(good, Vec3::UnitX()), 1e-5);
}

TEST(VmfMixture, KeepsTheFirstEight) {
  const auto lobes = random_lobes(12, 4);
  const VmfMixture mixture(lobes);
  ASSERT_EQ(mixture.count(), 8);
  EXPECT_EQ(mixture.component(7).kappa, lobes[7].kappa);
}

TEST(VmfMixture, WithoutLobesHasNoDensityAndStillGivesDirections) {
  for (const VmfMixture& none : {VmfMixture(), VmfMixture(std::span<const VmfComponent>())}) {
    EXPECT_EQ(none.count(), 0);
    EXPECT_EQ(none.pdf(Vec3::UnitY()), 0);
    EXPECT_NEAR(none.sample(0.5f, Vec2(0.3f, 0.6f)).norm(), 1, 1e-6);
  }
}

TEST(VmfMixture, ConcentrationsEndAtTheBound) {
  const float largest = std::numeric_limits<float>::max();
  const VmfMixture mixture(std::array{VmfComponent{1, Vec3::UnitX(), largest}});
  ASSERT_EQ(mixture.count(), 1);
  EXPECT_EQ(mixture.component(0).kappa, kMaxKappa);
  EXPECT_TRUE(std::isfinite(mixture.pdf(Vec3::UnitX())));
  EXPECT_NEAR(mixture.pdf(-Vec3::UnitX()), 0, 1e-20);
}

}  // namespace
}  // namespace waylight
