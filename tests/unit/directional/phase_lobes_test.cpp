#include "libguide/directional/phase_lobes.h"

#include <gtest/gtest.h>

#include "statistical/density_assertions.h"

namespace waylight {
namespace {

double henyey_greenstein(double g, double d) {  // d = 1 - cos theta
  const double base = (1 - g) * (1 - g) + 2 * g * d;
  return (1 - g * g) / (4 * std::numbers::pi * base * std::sqrt(base));
}

double lobes_density(const PhaseLobes& phase, double d) {
  double sum = 0;
  for (int k = 0; k < phase.count; ++k) {
    const PhaseLobe& lobe = phase.lobes[k];
    const double kappa = lobe.kappa, from_mean = lobe.sign > 0 ? d : 2 - d;
    const double norm = kappa > 0 ? kappa / -std::expm1(-2 * kappa) : 0.5;
    sum += lobe.weight * norm / (2 * std::numbers::pi) * std::exp(-kappa * from_mean);
  }
  return sum;
}

// Sums f(d) dw over the sphere, evenly by ln(1 + g^2 - 2 |g| cos theta) about the peak of HG(g).
template <typename Function>
double integrate(double g, const Function& f) {
  constexpr int kSteps = 20000;
  const double a = std::max(std::abs(g), 1e-4);
  const double low = 2 * std::log(1 - a), high = 2 * std::log(1 + a);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double base = std::exp(low + (high - low) * (i + 0.5) / kSteps);
    const double d = (base - (1 - a) * (1 - a)) / (2 * a);
    sum += f(g < 0 ? 2 - d : d) * base / (2 * a) * (high - low) / kSteps * 2 * std::numbers::pi;
  }
  return sum;
}

std::vector<float> all_g() {
  std::vector<float> result = {1e-5f, 1e-3f, 0.0011f, 0.95f, 0.97f, 0.99f};
  for (int i = 1; i <= 90; i += 3) result.push_back(0.01f * i);
  for (size_t i = 0, n = result.size(); i < n; ++i) result.push_back(-result[i]);
  return result;
}

TEST(PhaseLobes, MeanCosineIsG) {
  for (float g : all_g()) {
    const PhaseLobes phase = phase_lobes(g);
    const double mean = integrate(g, [&](double d) { return lobes_density(phase, d) * (1 - d); });
    EXPECT_NEAR(mean, g, 1e-4) << g;
    EXPECT_NEAR(phase.mean_cosine(), g, 1e-5) << g;
  }
}

// What four lobes leave grows with the decades of angle that HG spans: 0.03 up to |g| = 0.9, 0.06
// at 0.95 and 0.13 at 0.99.
TEST(PhaseLobes, ErrorIsWithinItsBound) {
  for (float g : all_g()) {
    const PhaseLobes phase = phase_lobes(g);
    const double error = integrate(g, [&](double d) {
      return std::abs(lobes_density(phase, d) - henyey_greenstein(std::abs(g), g < 0 ? 2 - d : d));
    });
    const double a = std::abs(g);
    EXPECT_LT(error, a <= 0.9001 ? 0.031 : a <= 0.9501 ? 0.06 : 0.131) << g;
  }
}

TEST(PhaseLobes, WeightsSumToOneAndTheDensityIntegratesToOne) {
  for (float g : all_g()) {
    const PhaseLobes phase = phase_lobes(g);
    float weight = 0;
    for (int k = 0; k < phase.count; ++k) weight += phase.lobes[k].weight;
    EXPECT_NEAR(weight, 1, 1e-6) << g;
    EXPECT_NEAR(integrate(g, [&](double d) { return phase.pdf(1 - d); }), 1, 2e-3) << g;
  }
}

TEST(PhaseLobes, UseAsFewLobesAsTheyNeed) {
  EXPECT_EQ(phase_lobes(0.1f).count, 1);
  EXPECT_EQ(phase_lobes(0.4f).count, 2);
  EXPECT_EQ(phase_lobes(-0.7f).count, 3);
  EXPECT_EQ(phase_lobes(0.9f).count, 4);
}

TEST(PhaseLobes, IsotropicIsOneUniformLobe) {
  const PhaseLobes phase = phase_lobes(0);
  ASSERT_EQ(phase.count, 1);
  EXPECT_EQ(phase.lobes[0].weight, 1);
  EXPECT_EQ(phase.lobes[0].kappa, 0);
  EXPECT_EQ(phase.pdf(0.3f), kSpherePdf);
}

TEST(PhaseLobes, BackwardIsTheMirrorImageOfForward) {
  const PhaseLobes forward = phase_lobes(0.6f), backward = phase_lobes(-0.6f);
  for (float cosine : {-1.0f, -0.3f, 0.0f, 0.8f, 1.0f})
    EXPECT_EQ(forward.pdf(cosine), backward.pdf(-cosine));
}

TEST(PhaseLobes, EndAtTheBoundOfG) {
  EXPECT_EQ(phase_lobes(1).pdf(0.999f), phase_lobes(0.99f).pdf(0.999f));
  EXPECT_EQ(phase_lobes(-kInfinity).pdf(0.9f), phase_lobes(-0.99f).pdf(0.9f));
  EXPECT_EQ(phase_lobes(std::nanf("")).pdf(0.5f), kSpherePdf);
}

TEST(PhaseLobes, MixtureAboutAnAxisIsTheSameDensity) {
  const Vec3 axis = Vec3(1, -2, 3).normalized();
  for (float g : {0.8f, -0.5f, 0.0f}) {
    const PhaseLobes phase = phase_lobes(g);
    const VmfMixture mixture = phase.about(axis);
    ASSERT_EQ(mixture.count(), phase.count);
    for (int i = 0; i < 100; ++i) {
      const Vec3 w = square_to_sphere(Sampler(1, 0, i).next_2d());
      EXPECT_NEAR(mixture.pdf(w), phase.pdf(axis.dot(w)), 1e-4f * mixture.pdf(w));
    }
  }
}

}  // namespace
}  // namespace waylight
