#include "libguide/directional/mixture_divergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace waylight {
namespace {

GaussianMixture mixture(std::initializer_list<GaussianComponent> components) {
  return GaussianMixture(std::span(components.begin(), components.size()));
}

TEST(MixtureDivergence, IsZeroFromAMixtureToItself) {
  const GaussianMixture m =
      mixture({{0.3f, -0.4f, 0, 0.02f, 0.01f, 0.03f}, {0.7f, 0.3f, 0.2f, 0.01f, 0, 0.04f}});
  EXPECT_EQ(divergence(m, m), 0);
}

// KL = (tr(S_q^-1 S_p) - 2 + d^T S_q^-1 d + ln(|S_q| / |S_p|)) / 2.
TEST(MixtureDivergence, IsThatOfTwoGaussians) {
  const GaussianMixture p = mixture({{1, 0, 0, 0.01f, 0, 0.01f}});
  const GaussianMixture q = mixture({{1, 0.1f, 0, 0.02f, 0, 0.01f}});
  const double exact = 0.5 * (1.5 - 2 + 0.1 * 0.1 / 0.02 + std::log(2));
  EXPECT_NEAR(divergence(p, q), exact, 0.1 * exact);
}

// KL = ln(c(k_p) / c(k_q)) + A(k_p) (k_p - k_q cos) with the densities c(k) e^(k cos - k), whose
// exponents differ by k_p - k_q.
TEST(MixtureDivergence, IsThatOfTwoLobesOnTheSphere) {
  const VmfComponent a = {1, Vec3::UnitZ(), 20};
  const VmfComponent b = {1, Vec3(0.6f, 0, 0.8f), 5};
  const double exact =
      std::log(vmf_norm(20) / vmf_norm(5)) - (20 - 5) + mean_cosine(20.0) * (20 - 5 * 0.8);
  EXPECT_NEAR(divergence(VmfMixture(std::span(&a, 1)), VmfMixture(std::span(&b, 1))), exact,
              0.05 * exact);
  EXPECT_EQ(divergence(VmfMixture(std::span(&a, 1)), VmfMixture(std::span(&a, 1))), 0);
}

TEST(MixtureDivergence, IsFiniteWhereTheOtherHasNothing) {
  const GaussianMixture p = mixture({{1, -0.9f, 0, 1e-6f, 0, 1e-6f}});
  const GaussianMixture q = mixture({{1, 0.9f, 0, 1e-6f, 0, 1e-6f}});
  EXPECT_NEAR(divergence(p, q), -std::log(1e-20), 1e-3);
}

}  // namespace
}  // namespace waylight
