// F1, F2, F3 of the stability cases over the sphere: degenerate, corrupt and extreme input of the
// trainer of media.

#include <gtest/gtest.h>

#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

using Points = std::vector<WeightedDirection>;
using Components = std::vector<VmfComponent>;

Components trained(const Points& points) {
  Components components = initial_vmf_components(points, 8, {});
  std::vector<VmfStatistics> statistics(components.size());
  float step = 0;
  for (int i = 1; i <= 10; ++i) {
    const float samples = static_cast<float>(i * points.size());
    const auto result = stepwise_vmf_update(components, statistics, step, points, samples, {});
    components.resize(result.count);
    statistics.resize(result.count);
  }
  return components;
}

// The directions in batch and as a stream.
std::vector<Components> fits(const Points& points) {
  return {fit_vmf_mixture(points, {}).components, trained(points)};
}

void expect_valid(const Components& components) {
  const VmfMixture mixture(components);
  ASSERT_EQ(mixture.count(), static_cast<int>(components.size()));
  ASSERT_GT(mixture.count(), 0);
  float weight = 0;
  for (const VmfComponent& c : components) {
    EXPECT_TRUE(c.kappa >= 0 && c.kappa <= kMaxKappa) << c.kappa;
    weight += c.weight;
  }
  EXPECT_NEAR(weight, 1, 1e-5);
  for (int i = 0; i < 256; ++i) {
    const float pdf = mixture.pdf(test::random_direction(1, i));
    EXPECT_TRUE(std::isfinite(pdf) && pdf >= 0) << pdf;
  }
}

Vec3 somewhere() { return Vec3(0.3f, -0.2f, 0.8f).normalized(); }

TEST(DegenerateDirections, OneSampleGivesOneLobeOfThePriorsWidth) {
  for (const Components& components : fits({{somewhere(), 2}})) {
    expect_valid(components);
    ASSERT_EQ(components.size(), 1u);
    EXPECT_LT((components[0].mean - somewhere()).norm(), 1e-6);
    EXPECT_GT(components[0].kappa, 20);
    EXPECT_LT(components[0].kappa, 210);  // ten updates
  }
}

TEST(DegenerateDirections, EqualSamplesGiveOneLobe) {
  for (const Components& components : fits(Points(1000, {somewhere(), 1}))) {
    expect_valid(components);
    EXPECT_EQ(components.size(), 1u);
  }
}

TEST(DegenerateDirections, FewerDistinctSamplesThanComponentsGiveAtMostAsManyLobes) {
  Points points;
  for (int i = 0; i < 300; ++i) points.push_back({Vec3::Unit(i % 3), 1});
  for (const Components& components : fits(points)) {
    expect_valid(components);
    EXPECT_EQ(components.size(), 3u);
  }
}

TEST(DegenerateDirections, SamplesOnAGreatCircleOrAtAntipodesAreAMixture) {
  Points circle, poles;
  for (int i = 0; i < 2000; ++i) {
    const float phi = 2 * kPi * i / 2000;
    circle.push_back({Vec3(std::cos(phi), std::sin(phi), 0), 1});
    poles.push_back({i % 2 ? Vec3::UnitZ() : Vec3(0, 0, -1), 1});
  }
  for (const Components& components : fits(circle)) expect_valid(components);
  for (const Components& components : fits(poles)) {
    expect_valid(components);
    EXPECT_EQ(components.size(), 2u);
  }
}

TEST(DegenerateDirections, OneLobeOfBalancedSamplesIsNearlyUniform) {
  const Points poles = {{Vec3::UnitZ(), 1}, {Vec3(0, 0, -1), 1}};
  VmfEmOptions options;
  options.components = 1;
  const Components components =
      fit_vmf_mixture(poles, options, std::array{VmfComponent{1, Vec3::UnitX(), 0}}).components;
  expect_valid(components);
  EXPECT_LT(components[0].kappa, 0.1f);
}

TEST(DegenerateDirections, NoSampleOrNoWeightGivesNoMixture) {
  EXPECT_TRUE(fit_vmf_mixture({}, {}).components.empty());
  const Points weightless(10, {somewhere(), 0});
  EXPECT_TRUE(fit_vmf_mixture(weightless, {}).components.empty());
  Components components = {{1, Vec3::UnitX(), 7}};
  std::vector<VmfStatistics> statistics(1);
  float step = 0;
  EXPECT_EQ(stepwise_vmf_update(components, statistics, step, weightless, 10, {}).count, 1);
  EXPECT_EQ(step, 0);
  EXPECT_EQ(components[0].kappa, 7);
}

Points ordinary(int count) { return test::draw(VmfMixture(test::random_lobes(4, 2)), count, 1); }

TEST(CorruptDirections, AreWithoutInfluence) {
  const Points good = ordinary(2000);
  Points bad = good;
  const float nan = std::nanf("");
  for (const WeightedDirection& p : {WeightedDirection{somewhere(), nan},
                                     {somewhere(), -1},
                                     {somewhere(), kInfinity},
                                     {Vec3(nan, 0, 0), 1},
                                     {Vec3(0, kInfinity, 0), 1},
                                     {Vec3(0.5f, 0.5f, 0), 1},
                                     {Vec3::Zero(), 0}})
    bad.push_back(p);
  const VmfEmResult clean = fit_vmf_mixture(good, {}), dirty = fit_vmf_mixture(bad, {});
  ASSERT_EQ(clean.components.size(), dirty.components.size());
  for (size_t k = 0; k < clean.components.size(); ++k)
    EXPECT_EQ(clean.components[k].mean, dirty.components[k].mean);
  for (const Components& components : fits(bad)) expect_valid(components);
}

double mass_near(const VmfMixture& mixture, const Vec3& centre, float cosine) {
  return test::integrate_sphere(
      [&](const Vec3& w) { return w.dot(centre) >= cosine ? mixture.pdf(w) : 0.0f; });
}

TEST(CorruptDirections, OneFireflyAmongManyIsBounded) {
  Points points = ordinary(10000);
  Vec3 place = Vec3::UnitX();  // where the others are fewest
  for (int i = 0; i < 200; ++i) {
    const VmfMixture mixture(test::random_lobes(4, 2));
    const Vec3 w = test::random_direction(3, i);
    if (mixture.pdf(w) < mixture.pdf(place)) place = w;
  }
  const double before = mass_near(VmfMixture(fit_vmf_mixture(points, {}).components), place, 0.99f);
  points.push_back({place, 1e30f});
  for (const Components& components : fits(points)) {
    expect_valid(components);
    // A share of 32 / 10000 at most.
    EXPECT_LT(mass_near(VmfMixture(components), place, 0.99f), before + 0.005);
  }
}

TEST(CorruptDirections, InASmallBatchAFireflyWeighsNoMoreThanAllOthersTogether) {
  Points points;
  for (int i = 0; i < 10; ++i) points.push_back({Vec3(-0.99f, 0.01f * i, 0).normalized(), 1});
  points.push_back({Vec3::UnitX(), 1e30f});
  for (const Components& components : fits(points)) {
    expect_valid(components);
    EXPECT_LT(mass_near(VmfMixture(components), Vec3::UnitX(), 0), 0.55);
  }
}

TEST(ExtremeDirections, HugeAndTinyWeightsDoNotOverflow) {
  for (float scale : {1e-38f, 1e30f}) {
    Points points = ordinary(1000);
    for (WeightedDirection& p : points) p.weight *= scale;
    for (const Components& components : fits(points)) expect_valid(components);
  }
}

TEST(ExtremeDirections, CollimatedLightEndsAtTheBoundOfKappa) {
  for (const Components& components : fits(Points(100000, {somewhere(), 1}))) {
    expect_valid(components);
    ASSERT_EQ(components.size(), 1u);
    EXPECT_EQ(components[0].kappa, kMaxKappa);
    EXPECT_LT((components[0].mean - somewhere()).norm(), 1e-6f);
    const VmfMixture mixture(components);
    EXPECT_TRUE(std::isfinite(mixture.pdf(somewhere())));
    EXPECT_GT(mixture.pdf(mixture.sample(0.5f, Vec2(0.9f, 0.1f))), 1);
  }
}

TEST(ExtremeDirections, LobesBeyondTheBoundAreTrainedFromAnyStart) {
  const Points points = ordinary(1000);
  VmfEmOptions options;
  const Components start = {{0.5f, Vec3::UnitX(), kInfinity}, {0.5f, Vec3::UnitY(), 1e30f}};
  expect_valid(fit_vmf_mixture(points, options, start).components);
}

}  // namespace
}  // namespace waylight
