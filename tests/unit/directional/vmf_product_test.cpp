#include "libguide/directional/vmf_product.h"

#include <gtest/gtest.h>

#include "statistical/density_assertions.h"
#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

using test::random_direction;
using test::random_lobes;

double integral_of_product(const std::vector<VmfComponent>& f, const std::vector<VmfComponent>& l) {
  return test::integrate_sphere(
      [&](const Vec3& w) { return test::density(f, w) * test::density(l, w); });
}

// The product mixture written out, in double.
double brute_force_z(const std::vector<VmfComponent>& f, const std::vector<VmfComponent>& l) {
  const auto log_norm = [](double kappa) {
    if (kappa < 1e-6) return -std::log(4 * std::numbers::pi);
    return std::log(kappa / (2 * std::numbers::pi * -std::expm1(-2 * kappa)));
  };
  double z = 0, wf = 0, wl = 0;
  for (const VmfComponent& a : f) wf += a.weight;
  for (const VmfComponent& b : l) wl += b.weight;
  for (const VmfComponent& a : f)
    for (const VmfComponent& b : l) {
      const Eigen::Vector3d sum = a.kappa * a.mean.cast<double>().normalized() +
                                  b.kappa * b.mean.cast<double>().normalized();
      const double kappa = sum.norm();
      z += a.weight / wf * b.weight / wl *
           std::exp(log_norm(a.kappa) + log_norm(b.kappa) - log_norm(kappa) + kappa - a.kappa -
                    b.kappa);
    }
  return z;
}

TEST(VmfProduct, ZIsTheIntegralOfTheProduct) {
  for (auto [k_f, k_l] : {std::pair{1, 1}, {2, 4}, {8, 8}}) {
    const auto f = random_lobes(k_f, 30 + k_f, 100), l = random_lobes(k_l, 60 + k_l, 100);
    const VmfMixture first(f), second(l);
    const VmfProduct product(first, second);
    ASSERT_TRUE(product.valid());
    const double z = integral_of_product(f, l);
    EXPECT_NEAR(product.z(), z, 3e-4 * z);
    EXPECT_NEAR(product.z(), brute_force_z(f, l), 1e-5 * z);
    for (int i = 0; i < 200; ++i) {
      const Vec3 w = random_direction(4, i);
      const double expected = test::density(f, w) * test::density(l, w) / z;
      EXPECT_NEAR(product.pdf(w), expected, 4e-4 * expected + 1e-6);
    }
  }
}

TEST(VmfProduct, SamplesFollowTheDensity) {
  for (auto [k_f, k_l] : {std::pair{2, 4}, {8, 8}, {4, 1}}) {
    const VmfMixture f(random_lobes(k_f, 40 + k_f)), l(random_lobes(k_l, 70 + k_l));
    const VmfProduct product(f, l);
    testing::expect_valid_density(
        testing::Sphere{}, std::to_string(k_f) + " by " + std::to_string(k_l),
        [&](Sampler& s) {
          const float u = s.next();
          return std::optional<Vec3>(product.sample(u, s.next_2d()));
        },
        [&](const Vec3& w) { return product.pdf(w); }, testing::DensityCheck{.tests = 10});
  }
}

TEST(VmfProduct, OfAnythingAndUniformIsTheSame) {
  const VmfMixture f(random_lobes(5, 3)), uniform(std::array{VmfComponent{3, Vec3::UnitX(), 0}});
  const VmfProduct product(f, uniform);
  ASSERT_TRUE(product.valid());
  EXPECT_NEAR(product.z(), kSpherePdf, 1e-6);
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = random_direction(2, i);
    EXPECT_NEAR(product.pdf(w), f.pdf(w), 1e-4f * f.pdf(w) + 1e-7f);
  }
}

TEST(VmfProduct, TheOrderOfTheMixturesDoesNotMatter) {
  const VmfMixture f(random_lobes(2, 1)), l(random_lobes(7, 2));
  const VmfProduct one(f, l), other(l, f);
  EXPECT_EQ(one.z(), other.z());
  for (int i = 0; i < 100; ++i) {
    Sampler s(3, 0, i);
    const float u = s.next();
    const Vec2 u2 = s.next_2d();
    EXPECT_EQ(one.sample(u, u2), other.sample(u, u2));
  }
}

TEST(VmfProduct, NarrowLobesThatDoNotMeetAreInvalidInsteadOfNaN) {
  const VmfMixture x(std::array{VmfComponent{1, Vec3::UnitX(), kMaxKappa}});
  for (const Vec3& mean : {Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(1, 0.05f, 0)}) {
    const VmfMixture other(std::array{VmfComponent{1, mean.normalized(), kMaxKappa}});
    const VmfProduct apart(x, other);
    EXPECT_FALSE(apart.valid()) << mean.transpose();
    EXPECT_EQ(apart.z(), 0);
  }
  EXPECT_FALSE(VmfProduct(x, VmfMixture()).valid());
  EXPECT_FALSE(VmfProduct(VmfMixture(), VmfMixture()).valid());
}

TEST(VmfProduct, LobesThatBarelyMeetAreStillExact) {
  // 0.025 rad of two lobes of kappa 1e5 apart: e^-15.6 of what they have in common when they agree.
  const Vec3 mean = Vec3(1, 0.025f, 0).normalized();
  const std::vector<VmfComponent> a = {{1, Vec3::UnitX(), kMaxKappa}}, b = {{1, mean, kMaxKappa}};
  const VmfMixture first(a), second(b);
  const VmfProduct product(first, second);
  ASSERT_TRUE(product.valid());
  EXPECT_NEAR(product.z() / brute_force_z(a, b), 1, 1e-3);
  double ratio = 0;  // the density of the one lobe kappa_i mean_i + kappa_j mean_j
  const Eigen::Vector3d sum =
      kMaxKappa * (Vec3::UnitX().cast<double>() + mean.cast<double>().normalized());
  for (int i = 0; i < 1024; ++i) {
    const Vec3 w = product.sample(0.5f, Sampler(2, 2, i).next_2d());
    const float lobe = vmf_pdf(sum.normalized().cast<float>(), sum.norm(), w);
    ratio += product.pdf(w) / lobe / 1024;
  }
  EXPECT_NEAR(ratio, 1, 2e-3);
}

TEST(VmfProduct, OppositeLobesMakeAUniformOne) {
  const VmfMixture up(std::array{VmfComponent{1, Vec3::UnitZ(), 10}});
  const VmfMixture down(std::array{VmfComponent{1, Vec3(0, 0, -1), 10}});
  const VmfProduct product(up, down);
  ASSERT_TRUE(product.valid());
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(product.pdf(random_direction(1, i)), kSpherePdf, 1e-4f * kSpherePdf);
  EXPECT_NEAR(product.sample(0.5f, Vec2(0.3f, 0.6f)).norm(), 1, 1e-6);
}

}  // namespace
}  // namespace waylight
