#include <gtest/gtest.h>

#include "libguide/base/error.h"
#include "libguide/base/sampler.h"
#include "libguide/math/warp.h"
#include "unit/scene/emitter_fixtures.h"

namespace waylight {
namespace {

using namespace fixtures;

// Mean and its standard error.
struct Estimate {
  double sum = 0, sum2 = 0;
  int count = 0;

  void add(double v) {
    sum += v;
    sum2 += v * v;
    ++count;
  }
  double mean() const { return sum / count; }
  double error() const { return std::sqrt(std::max(0.0, sum2 / count - mean() * mean()) / count); }
};

class EmitterTest : public testing::TestWithParam<EmitterCase> {};

TEST_P(EmitterTest, EmittedPowerIsTheWholePower) {
  const Scene scene(GetParam().make());
  if (GetParam().power == 0) GTEST_SKIP() << "power depends on the sphere around the scene";
  Estimate power;
  for (int i = 0; i < 20000; ++i) {
    Sampler sampler(1, 0, i);
    const float u = sampler.next();
    const Vec2 position = sampler.next_2d(), direction = sampler.next_2d();
    const auto emission = scene.sample_emission(u, position, direction);
    ASSERT_TRUE(emission);
    EXPECT_NEAR(emission->ray.direction.norm(), 1, 1e-5);
    power.add(emission->power.mean());
  }
  EXPECT_NEAR(power.mean(), GetParam().power, 4 * power.error() + 1e-4 * GetParam().power);
}

// Power that arrives on the upper side of the patch, by particles.
Estimate flux_by_emission(const Scene& scene, int count) {
  Estimate flux;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(2, 0, i);
    const float u = sampler.next();
    const Vec2 position = sampler.next_2d(), direction = sampler.next_2d();
    const auto emission = scene.sample_emission(u, position, direction);
    const auto hit = emission ? scene.intersect(emission->ray) : std::nullopt;
    const bool arrives = hit && hit->shape == 0 && hit->ng.dot(emission->ray.direction) < 0;
    flux.add(arrives ? emission->power.mean() : 0.0f);
  }
  return flux;
}

// The same by next-event estimation from points of the patch.
Estimate flux_by_light_samples(const Scene& scene, int count) {
  Estimate flux;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(3, 0, i);
    const Vec2 at = 0.5f * (sampler.next_2d() - Vec2(0.5f, 0.5f));
    const auto patch = scene.intersect({{at.x(), at.y(), 1e-3f}, -Vec3::UnitZ()});
    const float u = sampler.next();
    const auto light = scene.sample_light(patch->p, u, sampler.next_2d());
    double value = 0;
    if (light && light->wi.z() > 0)
      value = scene.visibility(*patch, light->wi, light->distance).x() * light->wi.z() *
              light->radiance.mean() / light->pdf * 0.25;
    flux.add(value);
  }
  return flux;
}

TEST_P(EmitterTest, ParticlesAndLightSamplesBringTheSameFlux) {
  const Scene scene(GetParam().make());
  const Estimate particles = flux_by_emission(scene, 60000);
  const Estimate samples = flux_by_light_samples(scene, 20000);
  const double error = std::hypot(particles.error(), samples.error());
  EXPECT_GT(samples.mean(), 0);
  EXPECT_NEAR(particles.mean(), samples.mean(), 4 * error);
  EXPECT_LT(error, 0.05 * samples.mean()) << "too noisy to prove anything";
}

// What a BSDF sample would find along the direction of a light sample agrees with that sample.
TEST_P(EmitterTest, DensityAndRadianceAgreeWithWhatARayFinds) {
  const Scene scene(GetParam().make());
  const Vec3 from(0.05f, 0.02f, 0.01f);
  for (int i = 0; i < 500; ++i) {
    Sampler sampler(4, 0, i);
    const float u = sampler.next();
    const auto light = scene.sample_light(from, u, sampler.next_2d());
    if (!light || light->is_delta) continue;
    const auto hit = scene.intersect({from, light->wi});
    if (hit && hit->emitter == kNone) continue;  // the patch itself is in the way
    const float density =
        hit ? scene.light_pdf(from, *hit, light->wi) : scene.environment_pdf(light->wi);
    const Color radiance = hit ? scene.emitted(*hit, -light->wi) : scene.environment(light->wi);
    EXPECT_NEAR(density, light->pdf, 1e-3f * light->pdf);
    if (std::string(GetParam().name).starts_with("textured")) continue;  // edges of the squares
    EXPECT_NEAR(radiance.mean(), light->radiance.mean(), 1e-3f * light->radiance.mean());
  }
}

INSTANTIATE_TEST_SUITE_P(AllEmitters, EmitterTest, testing::ValuesIn(emitter_cases()));

TEST(SpotLight, FallsOffLinearlyInTheAngle) {
  const Scene scene(
      patch_under(SpotLight{{0, 0, 1}, -Vec3::UnitZ(), Color::Constant(2), kPi / 4, kPi / 8}));
  const auto irradiance = [&](float angle) {
    const Vec3 at(std::tan(angle), 0, 0);
    const auto light = scene.sample_light(at, 0.5f, {0.5f, 0.5f});
    return light ? light->radiance.x() * sqr(light->distance) : 0.0f;
  };
  EXPECT_NEAR(irradiance(kPi / 9), 2, 1e-4);
  EXPECT_NEAR(irradiance(3 * kPi / 16), 1, 1e-4);
  EXPECT_EQ(irradiance(kPi / 3.9f), 0);
}

TEST(EnvironmentMap, ColumnsAndRowsPointWhereTheConventionSays) {
  const std::shared_ptr<Bitmap> picture = bitmap(64, 32, Color::Zero());
  picture->pixels[20 * 64 + 9] = Color::Ones();
  const Scene scene(patch_under(EnvironmentMap{picture}));
  const float phi = 2 * kPi * 9.5f / 64, theta = kPi * 20.5f / 32;
  const Vec3 w(std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta));
  EXPECT_NEAR(scene.environment(w).x(), 1, 1e-3);
  EXPECT_NEAR(scene.environment(-w).x(), 0, 1e-6);
  const auto light = scene.sample_light(Vec3::Zero(), 0.5f, {0.5f, 0.5f});
  ASSERT_TRUE(light);
  EXPECT_GT(light->wi.dot(w), std::cos(0.2f));
}

TEST(EnvironmentMap, DensityIsPositiveWhereverRadianceIsAndIntegratesToOne) {
  const Scene scene(patch_under(uneven_map()));
  constexpr int kSide = 1000;
  double integral = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vec3 w = square_to_sphere({(x + 0.5f) / kSide, (y + 0.5f) / kSide});
      const float density = scene.environment_pdf(w);
      integral += density * 4 * kPi / (kSide * kSide);
      ASSERT_TRUE(density > 0 || scene.environment(w).maxCoeff() <= 0);
    }
  EXPECT_NEAR(integral, 1, 2e-3);
}

TEST(Lights, DistantOnesThatOverlapAreSummed) {
  SceneDescription description = patch_under(ConstantEnvironment{Color::Constant(1)});
  description.emitters.push_back(DistantDisk{Vec3::UnitZ(), 0.9f, Color::Constant(5)});
  const Scene scene(std::move(description));
  EXPECT_NEAR(scene.environment(Vec3::UnitZ()).x(), 6, 1e-5);
  EXPECT_NEAR(scene.environment(Vec3::UnitX()).x(), 1, 1e-5);
  for (const float u : {0.01f, 0.99f}) {
    const auto light = scene.sample_light(Vec3::Zero(), u, {0.3f, 0.0f});
    ASSERT_TRUE(light);
    EXPECT_NEAR(light->pdf, scene.environment_pdf(light->wi), 1e-6);
    EXPECT_NEAR(light->radiance.x(), scene.environment(light->wi).x(), 1e-6);
  }
}

TEST(Lights, WithoutPowerAreNeverChosen) {
  SceneDescription description = patch_under(PointLight{{0, 0, 1}, Color::Zero()});
  description.emitters.push_back(PointLight{{0, 0, 2}, Color::Ones()});
  const Scene scene(std::move(description));
  for (const float u : {0.0f, 0.5f, kOneMinusEpsilon}) {
    EXPECT_NEAR(scene.sample_light(Vec3::Zero(), u, {0.5f, 0.5f})->distance, 2, 1e-6);
    EXPECT_EQ(scene.sample_emission(u, {0.5f, 0.5f}, {0.5f, 0.5f})->emitter, 1);
  }
  EXPECT_FALSE(Scene(patch_under(PointLight{{0, 0, 1}, Color::Zero()})).has_lights());
}

TEST(Lights, RefusesRadianceThatIsNotFinite) {
  EXPECT_THROW(Scene{patch_under(PointLight{{0, 0, 1}, Color::Constant(kInfinity)})}, Error);
  EXPECT_THROW(Scene{patch_under(ConstantEnvironment{Color::Constant(std::nanf(""))})}, Error);
  EXPECT_THROW(Scene{patch_under(DistantDisk{Vec3::UnitZ(), 1, Color::Ones()})}, Error);
}

}  // namespace
}  // namespace waylight
