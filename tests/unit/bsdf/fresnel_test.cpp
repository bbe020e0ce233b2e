#include "libguide/bsdf/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

namespace waylight {
namespace {

TEST(Fresnel, DielectricKnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5f).reflectance, 0.04f, 1e-6f);
  EXPECT_NEAR(fresnel_dielectric(1, 1 / 1.5f).reflectance, 0.04f, 1e-6f);
  EXPECT_EQ(fresnel_dielectric(0, 1.5f).reflectance, 1);
  EXPECT_EQ(fresnel_dielectric(0.5f, 1 / 1.5f).reflectance, 1);  // total, beyond 41.8 degrees
  EXPECT_NEAR(fresnel_dielectric(0.3f, 1).reflectance, 0, 1e-12f);
  // At Brewster's angle only the s part is reflected.
  const float brewster = std::cos(std::atan(1.5f));
  const float s = (1 - sqr(1.5f)) / (1 + sqr(1.5f));
  EXPECT_NEAR(fresnel_dielectric(brewster, 1.5f).reflectance, 0.5f * sqr(s), 1e-6f);
}

TEST(Fresnel, AConductorOfNoIndexReflectsAll) {
  for (const float cos : {1.0f, 0.7f, 1e-3f})
    EXPECT_NEAR(fresnel_conductor(cos, Color::Zero(), Color::Zero()).mean(), 1, 1e-5f) << cos;
}

TEST(Fresnel, BothSidesAgreeAlongARefractedRay) {
  for (float cos : {0.1f, 0.4f, 0.9f}) {
    const Fresnel in = fresnel_dielectric(cos, 1.7f);
    const Fresnel out = fresnel_dielectric(in.cos_t, 1 / 1.7f);
    EXPECT_NEAR(out.reflectance, in.reflectance, 1e-5f);
    EXPECT_NEAR(out.cos_t, cos, 1e-5f);
  }
}

// The textbook form in complex arithmetic.
double conductor(double cos, std::complex<double> n) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1 - cos * cos) / (n * n));
  const double s = std::norm((cos - n * cos_t) / (cos + n * cos_t));
  const double p = std::norm((n * cos - cos_t) / (n * cos + cos_t));
  return 0.5 * (s + p);
}

TEST(Fresnel, ConductorMatchesComplexArithmetic) {
  const Color eta(0.143f, 1.1f, 2.5f), k(3.98f, 0.4f, 1.6f);
  for (float cos : {0.01f, 0.1f, 0.5f, 0.8f, 1.0f})
    for (int c : {0, 1, 2})
      EXPECT_NEAR(fresnel_conductor(cos, eta, k)[c], conductor(cos, {eta[c], -k[c]}), 2e-5)
          << cos << " " << c;
}

TEST(Fresnel, ConductorWithoutAbsorptionIsADielectric) {
  for (float cos : {0.05f, 0.3f, 1.0f})
    EXPECT_NEAR(fresnel_conductor(cos, Color::Constant(1.5f), Color::Zero()).x(),
                fresnel_dielectric(cos, 1.5f).reflectance, 1e-5f);
}

TEST(Fresnel, MaterialNoneReflectsAll) {
  for (float cos : {0.0f, 0.2f, 1.0f})
    EXPECT_NEAR(fresnel_conductor(cos, Color::Zero(), Color::Constant(1e6f)).x(), 1, 1e-5f);
}

TEST(Fresnel, DiffuseReflectanceMatchesQuadrature) {
  for (float eta : {1.01f, 1.1f, 1.33f, 1.5f, 2.4f, 1 / 1.1f, 1 / 1.5f, 1 / 2.4f}) {
    double sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double cos = (i + 0.5) / n;
      sum += 2 * cos * fresnel_dielectric(static_cast<float>(cos), eta).reflectance / n;
    }
    EXPECT_NEAR(fresnel_diffuse_reflectance(eta), sum, 2e-4) << eta;
  }
  EXPECT_NEAR(fresnel_diffuse_reflectance(1), 0, 1e-6);
}

TEST(Fresnel, RefractionObeysSnellAndStaysUnit) {
  const Vec3 m = Vec3(0.2f, -0.1f, 0.9f).normalized(), w = Vec3(0.5f, 0.3f, 0.7f).normalized();
  for (float eta : {1.5f, 0.8f}) {
    const Fresnel f = fresnel_dielectric(w.dot(m), eta);
    const Vec3 t = refract(w, m, eta, f.cos_t);
    EXPECT_NEAR(t.norm(), 1, 1e-6f);
    EXPECT_NEAR(t.dot(m), -f.cos_t, 1e-5f);
    EXPECT_LT((eta * t.cross(m) + w.cross(m)).norm(), 1e-5f);
  }
}

}  // namespace
}  // namespace waylight
