#include "libguide/bsdf/bsdf.h"

#include "statistical/density_assertions.h"
#include "statistical/lobe_cases.h"

namespace waylight {
namespace {

using namespace testing;

std::string label(const LobeCase& c, const Vec3& wo) {
  return fmt::format("{} from ({:.3f}, {:.3f}, {:.3f})", c.name, wo.x(), wo.y(), wo.z());
}

std::optional<BsdfSample> draw(const Bsdf& bsdf, const Vec3& wo, uint64_t stream, uint32_t i) {
  Sampler sampler(11, stream, i);
  const float u = sampler.next();
  return bsdf.sample(wo, u, sampler.next_2d());
}

void expect_valid_bsdf(const Bsdf& bsdf, const Vec3& wo, const std::string& name, int tests) {
  DensityCheck check;
  check.tests = tests;
  check.samples = 40000;
  check.pilot = 4096;
  check.bins = 96;
  expect_valid_density(
      Sphere{}, name,
      [&](Sampler& sampler) -> std::optional<Vec3> {
        const float u = sampler.next();
        const std::optional<BsdfSample> s = bsdf.sample(wo, u, sampler.next_2d());
        if (!s) return std::nullopt;
        return s->wi;
      },
      [&](const Vec3& wi) { return bsdf.pdf(wo, wi); }, check);
}

TEST(BsdfSlow, DensityIsWhatTheSamplerMakes) {
  const std::vector<LobeCase> cases = smooth_lobes();
  for (const LobeCase& c : cases) {
    const auto* glass = std::get_if<RoughDielectric>(&c.lobe);
    if (glass && glass->mode == TransportMode::importance) continue;  // the same density
    for (const Vec3& wo : directions(c.both_sides))
      expect_valid_bsdf(bsdf_of(c.lobe), wo, label(c, wo), 200);
  }
}

TEST(BsdfSlow, MixturesSampleTheirWholeDensity) {
  Bsdf bsdf;
  bsdf.add(Diffuse{Color(0.2f, 0.4f, 0.1f)}, 0.3f);
  bsdf.add(Phong{Color::Constant(0.3f), Color::Constant(0.4f), 50}, 0.2f);
  bsdf.add(
      RoughDielectric{1.5f, Color::Ones(), Color::Ones(),
                      facets(0.2f, 0.2f, MicrofacetDistribution::ggx), TransportMode::radiance},
      0.4f);
  bsdf.add(plastic(Color::Constant(0.5f), 1.5f, false), 0.1f);
  for (const Vec3& wo : directions(true)) {
    expect_valid_bsdf(bsdf, wo, fmt::format("mixture from z = {}", wo.z()), 8);
    const float delta = bsdf.delta_prob(wo);
    EXPECT_GE(delta, 0);
    EXPECT_LT(delta, 1);
  }
}

TEST(Bsdf, WeightIsEvalOverPdf) {
  for (const LobeCase& c : smooth_lobes()) {
    const Bsdf bsdf = bsdf_of(c.lobe, 0.7f);
    for (const Vec3& wo : directions(c.both_sides))
      for (int i = 0; i < 64; ++i) {
        const std::optional<BsdfSample> s = draw(bsdf, wo, 1, i);
        if (!s) continue;
        const Color value = bsdf.eval(wo, s->wi);
        const EvalPdf both = bsdf.evaluate(wo, s->wi);
        ASSERT_NEAR(s->wi.norm(), 1, 1e-5f) << label(c, wo);
        ASSERT_NEAR(bsdf.pdf(wo, s->wi) / s->pdf, 1, 1e-4f) << label(c, wo);
        ASSERT_LT((s->weight * s->pdf - value).abs().maxCoeff(), 1e-4f * value.maxCoeff() + 1e-7f)
            << label(c, wo);
        ASSERT_NEAR(both.pdf / s->pdf, 1, 1e-4f) << label(c, wo);
        ASSERT_LT((both.value - value).abs().maxCoeff(), 1e-4f * value.maxCoeff() + 1e-7f);
        ASSERT_EQ(s->eta == 1, wo.z() * s->wi.z() > 0) << label(c, wo);
      }
  }
}

// Light reflected and transmitted of a uniform unit radiance: smooth part and delta part.
Color albedo(const Bsdf& bsdf, const Vec3& wo, int count) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const float delta = bsdf.delta_prob(wo);
  for (int i = 0; i < count; ++i) {
    if (delta < 1) {
      if (const std::optional<BsdfSample> s = draw(bsdf, wo, 2, i)) sum += s->weight.cast<double>();
    }
    if (delta > 0) {
      if (const std::optional<BsdfSample> s = bsdf.sample_delta(wo, Sampler(3, 3, i).next()))
        sum += s->weight.cast<double>();
    }
  }
  return (sum / count).cast<float>();
}

// Refraction into a denser side concentrates radiance by eta^2: only power is bounded by one.
bool bounded_by_one(const LobeCase& c) {
  if (const auto* d = std::get_if<RoughDielectric>(&c.lobe))
    return d->mode == TransportMode::importance;
  if (const auto* d = std::get_if<Dielectric>(&c.lobe)) return d->mode == TransportMode::importance;
  const auto* ward = std::get_if<Ward>(&c.lobe);
  return !ward || ward->variant == Ward::Variant::balanced;
}

TEST(Bsdf, WhiteFurnaceGainsNoEnergy) {
  std::vector<LobeCase> cases = smooth_lobes();
  for (const LobeCase& c : delta_lobes()) cases.push_back(c);
  for (const LobeCase& c : cases) {
    if (!bounded_by_one(c)) continue;
    std::vector<Vec3> from = directions(c.both_sides);
    from.push_back(direction(89.9f, 0.3f));
    for (const Vec3& wo : from)
      EXPECT_LE(albedo(bsdf_of(c.lobe), wo, 4096).maxCoeff(), 1.005f) << label(c, wo);
  }
}

TEST(Bsdf, WhiteFurnaceKeepsAllEnergyWithoutShadowing) {
  std::vector<LobeCase> cases = smooth_lobes();
  for (const LobeCase& c : delta_lobes()) cases.push_back(c);
  for (const LobeCase& c : cases) {
    const auto* metal = std::get_if<RoughConductor>(&c.lobe);
    const auto* glass = std::get_if<RoughDielectric>(&c.lobe);
    const bool rough =
        (metal && metal->facets.alpha_v > 0.02f) || (glass && glass->facets.alpha_v > 0.02f);
    if (!c.lossless_when_smooth || rough) continue;
    for (const Vec3& wo : directions(c.both_sides)) {
      if (std::abs(wo.z()) < 0.4f) continue;
      EXPECT_NEAR(albedo(bsdf_of(c.lobe), wo, 4096).minCoeff(), 1, 0.01f) << label(c, wo);
    }
  }
}

TEST(Bsdf, WhitePlasticLosesNothing) {
  for (bool nonlinear : {false, true})
    for (const Vec3& wo : directions(false))
      EXPECT_NEAR(albedo(bsdf_of(plastic(Color::Ones(), 1.5f, nonlinear)), wo, 16384).x(), 1,
                  2e-3f);
}

TEST(Bsdf, RoughPlasticTendsToPlastic) {
  for (const Vec3& wo : directions(false)) {
    const RoughPlastic rough =
        rough_plastic(Color(0.9f, 0.5f, 0.1f), 1.49f, 1e-3f, MicrofacetDistribution::ggx);
    const Color expected =
        albedo(bsdf_of(plastic(Color(0.9f, 0.5f, 0.1f), 1.49f, true)), wo, 16384);
    EXPECT_LT((albedo(bsdf_of(rough), wo, 16384) - expected).abs().maxCoeff(), 0.012f) << wo.z();
  }
}

// f(wo, wi) / n(wo)^2 = f(wi, wo) / n(wi)^2 for radiance [Veach 1997, equation 5.14]; Ward's and
// Phong's lobes are symmetric too.
TEST(Bsdf, ReciprocalUpToSquaredIndex) {
  for (const LobeCase& c : smooth_lobes()) {
    const auto* glass = std::get_if<RoughDielectric>(&c.lobe);
    if (glass && glass->mode == TransportMode::importance) continue;
    const Bsdf bsdf = bsdf_of(c.lobe);
    const auto index = [&](const Vec3& w) { return glass && w.z() < 0 ? glass->eta : 1.0f; };
    int compared = 0;
    for (const Vec3& wo : directions(c.both_sides))
      for (int i = 0; i < 64; ++i) {
        const std::optional<BsdfSample> s = draw(bsdf, wo, 4, i);
        if (!s || std::abs(s->wi.z()) < 0.05f) continue;
        const double there = bsdf.eval(wo, s->wi).x() / std::abs(s->wi.z()) / sqr(index(wo));
        const double back = bsdf.eval(s->wi, wo).x() / std::abs(wo.z()) / sqr(index(s->wi));
        // Rounding of the half vector weighs against the width of the lobe.
        ASSERT_NEAR(back / there, 1, 0.02) << label(c, wo) << " to " << s->wi.transpose();
        ++compared;
      }
    EXPECT_GT(compared, 100) << c.name;
  }
}

// Importance flows through an interface as radiance does the other way.
TEST(Bsdf, ImportanceIsTheAdjointOfRadiance) {
  const Microfacet m = facets(0.3f, 0.3f, MicrofacetDistribution::ggx);
  const RoughDielectric radiance{1.5f, Color::Ones(), Color::Ones(), m, TransportMode::radiance};
  const RoughDielectric importance{1.5f, Color::Ones(), Color::Ones(), m,
                                   TransportMode::importance};
  for (const Vec3& wo : directions(true))
    for (int i = 0; i < 64; ++i) {
      const std::optional<BsdfSample> s = draw(bsdf_of(radiance), wo, 5, i);
      if (!s) continue;
      const float there = radiance.eval(wo, s->wi).x() / std::abs(s->wi.z());
      const float back = importance.eval(s->wi, wo).x() / std::abs(wo.z());
      ASSERT_NEAR(back / there, 1, 2e-3f) << wo.transpose() << " to " << s->wi.transpose();
    }
}

TEST(Bsdf, DeltaPartsSumToTheirEnergy) {
  for (const LobeCase& c : delta_lobes()) {
    const Bsdf bsdf = bsdf_of(c.lobe);
    for (const Vec3& wo : directions(c.both_sides)) {
      // Each direction met, with its probability.
      std::vector<BsdfSample> met;
      for (int i = 0; i < 256; ++i) {
        const std::optional<BsdfSample> s = bsdf.sample_delta(wo, (i + 0.5f) / 256);
        if (!s) continue;
        const bool known = std::any_of(met.begin(), met.end(),
                                       [&](const BsdfSample& other) { return other.wi == s->wi; });
        if (!known) met.push_back(*s);
      }
      float prob = 0;
      for (const BsdfSample& s : met) prob += s.pdf;
      EXPECT_NEAR(prob, 1, 1e-5f) << label(c, wo);
      EXPECT_LE(met.size(), 2u) << label(c, wo);
    }
  }
}

TEST(Bsdf, SnellsLawAndTotalReflection) {
  const Dielectric glass{1.5f, Color::Ones(), Color::Ones(), TransportMode::radiance};
  const Vec3 wo = direction(40, 0.7f);
  const std::optional<BsdfSample> in = glass.sample_delta(wo, 0.999f);
  ASSERT_TRUE(in && in->wi.z() < 0);
  EXPECT_NEAR(1.5f * in->wi.head<2>().norm(), wo.head<2>().norm(), 1e-6f);
  EXPECT_LT((1.5f * in->wi.head<2>() + wo.head<2>()).norm(), 1e-6f);
  EXPECT_FLOAT_EQ(in->eta, 1.5f);
  EXPECT_NEAR(in->weight.x(), 1 / 2.25f, 1e-6f);
  const std::optional<BsdfSample> out = glass.sample_delta(in->wi, 0.999f);
  ASSERT_TRUE(out);
  EXPECT_LT((out->wi - wo).norm(), 1e-5f);
  EXPECT_NEAR(out->weight.x(), 2.25f, 1e-5f);
  const std::optional<BsdfSample> inside = glass.sample_delta(direction(130, 0), 0.999f);
  ASSERT_TRUE(inside);  // the critical angle is 41.8 degrees
  EXPECT_LT(inside->wi.z(), 0);
  EXPECT_EQ(inside->weight.x(), 1);
}

TEST(Bsdf, DeltaProbabilityIsUsedByMixtures) {
  Bsdf bsdf;
  bsdf.add(Diffuse{Color::Constant(0.5f)}, 0.5f);
  bsdf.add(Conductor{Color::Zero(), Color::Constant(1e6f), Color::Ones()}, 0.5f);
  const Vec3 wo = direction(30, 1);
  const float delta = bsdf.delta_prob(wo);
  EXPECT_NEAR(delta, 1 / 1.5f, 1e-3f);  // by reflectance
  const std::optional<BsdfSample> mirror = bsdf.sample_delta(wo, 0.5f);
  ASSERT_TRUE(mirror);
  EXPECT_NEAR(mirror->weight.x(), 0.5f, 1e-5f);
  EXPECT_NEAR(albedo(bsdf, wo, 1024).x(), 0.75f, 1e-3f);
}

TEST(Bsdf, OneSidedLobesAreBlackBelow) {
  for (const LobeCase& c : smooth_lobes()) {
    if (c.both_sides) continue;
    const Bsdf bsdf = bsdf_of(c.lobe);
    const Vec3 below = direction(120, 1), above = direction(30, 0);
    EXPECT_FALSE(draw(bsdf, below, 1, 0)) << c.name;
    EXPECT_EQ(bsdf.eval(below, above).maxCoeff(), 0) << c.name;
    EXPECT_EQ(bsdf.eval(above, below).maxCoeff(), 0) << c.name;
    EXPECT_EQ(bsdf.pdf(below, above), 0) << c.name;
    EXPECT_EQ(bsdf.pdf(above, below), 0) << c.name;
    EXPECT_FALSE(bsdf.sample_delta(below, 0.5f)) << c.name;
  }
}

// Extreme roughness, elevations down to the horizon, corners of the unit cube.
TEST(Bsdf, NothingIsEverNotFinite) {
  std::vector<LobeCase> cases = smooth_lobes();
  for (float alpha : {1e-4f, 1.0f, 10.0f})
    for (MicrofacetDistribution kind :
         {MicrofacetDistribution::ggx, MicrofacetDistribution::beckmann}) {
      const Microfacet m = facets(alpha, 1e-4f, kind);
      cases.push_back({fmt::format("metal {}", alpha),
                       RoughConductor{Color::Ones(), Color::Ones(), Color::Ones(), m}});
      for (float eta : {1.0002f, 1.5f, 3.0f, 0.5f})
        cases.push_back(
            {fmt::format("glass {} {}", alpha, eta),
             RoughDielectric{eta, Color::Ones(), Color::Ones(), m, TransportMode::radiance}, true});
    }
  cases.push_back({"black phong", Phong{Color::Zero(), Color::Zero(), 10}});
  cases.push_back({"sharp phong", Phong{Color::Zero(), Color::Ones(), 1e8f}});
  for (const LobeCase& c : cases) {
    const Bsdf bsdf = bsdf_of(c.lobe);
    for (float z : {1.0f, 0.5f, 1e-2f, 1e-4f, 1e-7f, 1e-20f, 0.0f, -1e-20f, -1e-4f, -0.7f, -1.0f}) {
      const Vec3 wo = Vec3(std::sqrt(1 - z * z) * 0.6f, std::sqrt(1 - z * z) * 0.8f, z);
      for (float u : {0.0f, 0.5f, kOneMinusEpsilon})
        for (float v : {0.0f, 1e-6f, 0.37f, kOneMinusEpsilon})
          for (float w : {0.0f, 0.25f, 0.5f, kOneMinusEpsilon}) {
            const std::optional<BsdfSample> s = bsdf.sample(wo, u, {v, w});
            const std::string where = label(c, wo) + fmt::format(" u {} {} {}", u, v, w);
            ASSERT_TRUE(std::isfinite(bsdf.delta_prob(wo))) << where;
            if (!s) continue;
            ASSERT_TRUE(s->wi.allFinite()) << where;
            ASSERT_TRUE(is_finite(s->weight) && s->weight.minCoeff() >= 0) << where;
            ASSERT_TRUE(std::isfinite(s->pdf) && s->pdf > 0) << where;
            const EvalPdf back = bsdf.evaluate(s->wi, wo);
            ASSERT_TRUE(is_finite(back.value) && std::isfinite(back.pdf)) << where;
            const EvalPdf straight = bsdf.evaluate(wo, -wo);
            ASSERT_TRUE(is_finite(straight.value) && std::isfinite(straight.pdf)) << where;
          }
    }
  }
}

TEST(Bsdf, StaysSmall) {
  EXPECT_LE(sizeof(Lobe), 96u);
  EXPECT_LE(sizeof(Bsdf), 4 * sizeof(Lobe) + 48);
}

}  // namespace
}  // namespace waylight
