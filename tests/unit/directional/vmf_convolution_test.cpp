#include "libguide/directional/vmf_convolution.h"

#include <gtest/gtest.h>

#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

constexpr int kOrders = 300;
using Series = std::vector<double>;  // Legendre coefficients; convolutions multiply them

Series henyey_greenstein_series(double g) {
  Series a(kOrders);
  for (int l = 0; l < kOrders; ++l) a[l] = std::pow(g, l);
  return a;
}

// I_{l + 1/2}(kappa) / I_{1/2}(kappa), by its recurrence downwards.
Series vmf_series(double kappa, double sign = 1) {
  Series a(kOrders + 60, 0.0);
  a[a.size() - 2] = 1e-250;
  for (size_t l = a.size() - 2; l > 0; --l) {
    a[l - 1] = a[l + 1] + (2.0 * l + 1) / kappa * a[l];
    if (a[l - 1] > 1e100)
      for (double& v : a) v *= 1e-200;
  }
  const double first = a[0];
  for (size_t l = 0; l < a.size(); ++l) a[l] *= (l % 2 ? sign : 1) / first;
  a.resize(kOrders);
  return a;
}

Series lobes_series(const PhaseLobes& phase) {
  Series sum(kOrders, 0.0);
  for (int k = 0; k < phase.count; ++k) {
    const Series lobe = vmf_series(phase.lobes[k].kappa, phase.lobes[k].sign);
    for (int l = 0; l < kOrders; ++l) sum[l] += phase.lobes[k].weight * lobe[l];
  }
  return sum;
}

// Of two zonal densities, in the direction of polar cosine t.
double convolved(const Series& a, const Series& b, double t) {
  double before = 1, p = t, sum = 1 + 3 * a[1] * b[1] * t;
  for (int l = 2; l < kOrders; ++l) {
    const double next = ((2 * l - 1) * t * p - (l - 1) * before) / l;
    before = p, p = next;
    sum += (2 * l + 1) * a[l] * b[l] * p;
  }
  return sum / (4 * std::numbers::pi);
}

float convolved_pdf(const VmfMixture& light, const PhaseLobes& phase, const Vec3& w) {
  return VmfConvolution(light, phase).pdf(w);
}

VmfMixture light_about_z(float kappa) {
  return VmfMixture(std::array{VmfComponent{1, Vec3::UnitZ(), kappa}});
}

struct Error {
  double l1 = 0, least = 1e9, largest = 0;
};

Error error_of(float kappa, const PhaseLobes& phase, const Series& exact_phase) {
  const VmfConvolution convolution(light_about_z(kappa), phase);
  const Series light = vmf_series(kappa);
  constexpr int kSteps = 400;
  Error error;
  for (int i = 0; i < kSteps; ++i) {
    const double v = (i + 0.5) / kSteps, theta = std::numbers::pi * v * v;
    const Vec3 w(std::sin(theta), 0, std::cos(theta));
    const double expected = convolved(light, exact_phase, std::cos(theta));
    const double found = convolution.pdf(w), ratio = found / expected;
    const double solid_angle =
        2 * std::numbers::pi * std::sin(theta) * 2 * std::numbers::pi * v / kSteps;
    error.l1 += std::abs(found - expected) * solid_angle;
    error.least = std::min(error.least, ratio), error.largest = std::max(error.largest, ratio);
  }
  return error;
}

TEST(VmfConvolution, ReferenceIsTheIntegralItself) {
  const double g = 0.6;
  const float kappa = 4;
  for (double theta : {0.0, 0.7, 2.5}) {
    const Vec3 w(std::sin(theta), 0, std::cos(theta));
    const double integral = test::integrate_sphere([&](const Vec3& v) {
      const double base = 1 + g * g - 2 * g * v.dot(w);
      const double phase = (1 - g * g) / (4 * std::numbers::pi * base * std::sqrt(base));
      return phase * test::density({1, Vec3::UnitZ(), kappa}, v);
    });
    const double series =
        convolved(henyey_greenstein_series(g), vmf_series(kappa), std::cos(theta));
    EXPECT_NEAR(integral / series, 1, 1e-3);
  }
}

TEST(VmfConvolution, ErrorIsWithinItsBound) {
  for (float g : {-0.9f, -0.5f, 0.2f, 0.5f, 0.7f, 0.9f}) {
    const PhaseLobes phase = phase_lobes(g);
    const Series lobes = lobes_series(phase);
    for (float kappa : {0.3f, 1.0f, 3.0f, 10.0f, 100.0f}) {
      const Error error = error_of(kappa, phase, lobes);
      EXPECT_LT(error.l1, 0.031) << g << " " << kappa;
      EXPECT_GT(error.least, 0.955) << g << " " << kappa;
      EXPECT_LT(error.largest, 1.175) << g << " " << kappa;
      EXPECT_LT(error_of(kappa, phase, henyey_greenstein_series(g)).l1, 0.031) << g << " " << kappa;
    }
  }
}

TEST(VmfConvolution, IntegratesToOneWithTheProductOfTheMeanCosines) {
  for (float g : {-0.8f, 0.0f, 0.9f}) {
    const VmfMixture light = light_about_z(5);
    const VmfConvolution convolution(light, phase_lobes(g));
    double total = 0, mean = 0;
    test::integrate_sphere([&](const Vec3& w) {
      total += convolution.pdf(w), mean += convolution.pdf(w) * w.z();
      return 0.0;
    });
    EXPECT_NEAR(mean / total, g * mean_cosine(5), 1e-3) << g;
    EXPECT_NEAR(total * 4 * std::numbers::pi / (2.0 * 400 * 400), 1, 1e-3) << g;
  }
}

TEST(VmfConvolution, OfAMixtureIsTheSumOfThoseOfItsLobes) {
  const auto lobes = test::random_lobes(8, 3);
  const PhaseLobes phase = phase_lobes(0.6f);
  const VmfMixture mixture(lobes);
  float weight = 0;
  for (const VmfComponent& c : lobes) weight += c.weight;
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = test::random_direction(1, i);
    double sum = 0;
    for (const VmfComponent& c : lobes)
      sum += c.weight / weight * convolved_pdf(VmfMixture(std::span(&c, 1)), phase, w);
    EXPECT_NEAR(convolved_pdf(mixture, phase, w), sum, 1e-5 * sum);
  }
}

TEST(VmfConvolution, WithIsotropicScatteringIsUniform) {
  const VmfMixture light(test::random_lobes(8, 1, kMaxKappa));
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(convolved_pdf(light, phase_lobes(0), test::random_direction(1, i)), kSpherePdf,
                1e-5f * kSpherePdf);
}

TEST(VmfConvolution, OfCollimatedLightIsThePhaseFunctionAndFinite) {
  const VmfMixture light = light_about_z(kMaxKappa);
  for (float g : {0.5f, 0.99f, -0.99f}) {
    const PhaseLobes phase = phase_lobes(g);
    for (float cosine : {-1.0f, 0.2f, 1.0f}) {
      const Vec3 w(safe_sqrt(1 - cosine * cosine), 0, cosine);
      const float expected = phase.pdf(cosine), found = convolved_pdf(light, phase, w);
      EXPECT_NEAR(found, expected, 0.15f * expected) << g << " " << cosine;
    }
  }
  EXPECT_EQ(convolved_pdf(VmfMixture(), phase_lobes(0.5f), Vec3::UnitX()), 0);
  EXPECT_EQ(convolved_pdf(light, PhaseLobes(), Vec3::UnitX()), 0);
}

}  // namespace
}  // namespace waylight
