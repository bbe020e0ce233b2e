#include "libguide/bsdf/microfacet.h"

#include "statistical/density_assertions.h"
#include "statistical/lobe_cases.h"

namespace waylight {
namespace {

using namespace testing;

std::vector<Microfacet> all_facets() {
  std::vector<Microfacet> result;
  for (MicrofacetDistribution kind :
       {MicrofacetDistribution::ggx, MicrofacetDistribution::beckmann})
    for (const auto& [u, v] :
         std::vector<std::pair<float, float>>{{0.01f, 0.01f}, {0.3f, 0.3f}, {1, 1}, {0.05f, 0.8f}})
      result.push_back({u, v, kind});
  return result;
}

std::string label(const Microfacet& m) {
  return fmt::format("{} {} {}", m.distribution == MicrofacetDistribution::ggx ? "ggx" : "beckmann",
                     m.alpha_u, m.alpha_v);
}

TEST(Microfacet, ProjectedAreaOfNormalsIsOne) {
  for (const Microfacet& m : all_facets()) {
    if (m.alpha_u < 0.05f) continue;  // plain quadrature resolves no narrower peak
    const auto projected = [&](const Vec3& n) { return m.d(n) * std::max(n.z(), 0.0f); };
    EXPECT_NEAR(integrate_density(Sphere{}, projected), 1, 2e-3) << label(m);
  }
}

// The masking function is what makes visible normals a density [Heitz 2014, equation 14].
TEST(Microfacet, VisibleNormalsAreADensity) {
  for (const Microfacet& m : all_facets())
    for (const Vec3& w :
         {direction(0, 0), direction(40, 0.3f), direction(80, 1), direction(89.5f, 2)}) {
      DensityCheck check;
      check.tests = 32;
      expect_valid_density(
          Sphere{}, label(m) + fmt::format(" from z = {}", w.z()),
          [&](Sampler& s) { return std::make_optional(m.sample(w, s.next_2d())); },
          [&](const Vec3& n) { return m.pdf(w, n); }, check);
    }
}

TEST(Microfacet, MaskingIsOneAtNormalIncidenceAndFallsToZero) {
  for (const Microfacet& m : all_facets()) {
    EXPECT_NEAR(m.g1(Vec3::UnitZ()), 1, 1e-6f) << label(m);
    float last = 1;
    for (float degrees : {20.0f, 60.0f, 85.0f, 89.0f, 89.99f}) {
      const float g = m.g1(direction(degrees, 0.4f));
      EXPECT_LE(g, last + 1e-6f) << label(m);
      last = g;
    }
    EXPECT_LT(m.g1(direction(89.9999f, 0.4f)), 0.01f) << label(m);
  }
}

// Away from the peak by powers of the CDF: the tails of the inversion, not only its middle.
TEST(Microfacet, BeckmannSlopesAtNormalIncidenceAreGaussian) {
  const Microfacet m{0.2f, 0.2f, MicrofacetDistribution::beckmann};
  constexpr int n = 1 << 16;
  double second = 0, fourth = 0;
  for (int i = 0; i < n; ++i) {
    const Vec3 normal = m.sample(Vec3::UnitZ(), Sampler(1, 1, i).next_2d());
    const double slope = normal.x() / normal.z() / 0.2;
    second += slope * slope / n;
    fourth += slope * slope * slope * slope / n;
  }
  EXPECT_NEAR(second, 0.5, 1e-3);  // variance of exp(-s^2)
  EXPECT_NEAR(fourth, 0.75, 5e-3);
}

TEST(RoughTransmittance, TendsToTheSmoothInterface) {
  for (MicrofacetDistribution kind :
       {MicrofacetDistribution::ggx, MicrofacetDistribution::beckmann}) {
    const RoughTransmittance& table = rough_transmittance(kind, 1.5f);
    const RoughTransmittance::Row row = table.row(1e-4f);
    for (float cos : {0.05f, 0.1f, 0.33f, 0.7f, 1.0f})
      EXPECT_NEAR(table.transmittance(row, cos), 1 - fresnel_dielectric(cos, 1.5f).reflectance,
                  4e-3f);
    EXPECT_NEAR(table.internal_reflectance(row), fresnel_diffuse_reflectance(1 / 1.5f), 2e-3f);
  }
}

TEST(RoughTransmittance, IsOneTablePerInterface) {
  const RoughTransmittance& a = rough_transmittance(MicrofacetDistribution::ggx, 1.3f);
  rough_transmittance(MicrofacetDistribution::beckmann, 1.3f);
  EXPECT_EQ(&a, &rough_transmittance(MicrofacetDistribution::ggx, 1.3f));
}

// Against a plain Monte Carlo estimate of the definition, at roughness between the nodes.
TEST(RoughTransmittance, MatchesSampling) {
  const float alpha = 0.37f, eta = 1.49f;
  const Microfacet m{alpha, alpha, MicrofacetDistribution::ggx};
  const RoughTransmittance& table = rough_transmittance(m.distribution, eta);
  for (float degrees : {10.0f, 50.0f, 80.0f}) {
    const Vec3 w = direction(degrees, 0);
    double sum = 0;
    constexpr int n = 1 << 14;
    for (int i = 0; i < n; ++i) {
      const Vec3 normal = m.sample(w, Sampler(2, 1, i).next_2d());
      const Fresnel f = fresnel_dielectric(std::clamp(w.dot(normal), 0.0f, 1.0f), eta);
      const Vec3 t = refract(w, normal, eta, f.cos_t);
      if (t.z() < 0) sum += (1 - f.reflectance) * m.g1(-t) / n;
    }
    EXPECT_NEAR(table.transmittance(table.row(alpha), w.z()), sum, 4e-3) << degrees;
  }
}

}  // namespace
}  // namespace waylight
