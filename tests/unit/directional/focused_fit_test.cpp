#include "libguide/directional/focused_fit.h"

#include <gtest/gtest.h>

#include "libguide/directional/focused_mixture.h"
#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

constexpr float kFar = 1e4f;

struct Light {
  Vec3 focus;
  float radius;
};

// Places in the cube of [-1, 1]; of their directions every other one is that of the light, the rest
// are uniform.
std::vector<PlacedDirection> photons_of(const Light& light, int count, uint64_t seed) {
  std::vector<PlacedDirection> photons;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec2 u = sampler.next_2d();
    const Vec3 p(2 * u.x() - 1, 2 * u.y() - 1, 2 * sampler.next() - 1);
    const Vec3 on_ball = light.focus + light.radius * square_to_sphere(sampler.next_2d());
    const Vec3 uniform = square_to_sphere(sampler.next_2d());
    photons.push_back({p, i % 2 ? (on_ball - p).normalized() : uniform, 1});
  }
  return photons;
}

std::vector<VmfComponent> without_places(const std::vector<PlacedDirection>& photons) {
  std::vector<WeightedDirection> directions;
  for (const PlacedDirection& p : photons) directions.push_back({p.direction, p.weight});
  return fit_vmf_mixture(directions, {}).components;
}

std::vector<FocusedLobe> fit(const std::vector<PlacedDirection>& photons) {
  return fit_focused_lobes(photons, without_places(photons), {}, kFar);
}

double mean_log_density(const std::vector<PlacedDirection>& photons, const auto& seen_from) {
  double sum = 0;
  for (const PlacedDirection& p : photons) sum += std::log(seen_from(p.position).pdf(p.direction));
  return sum / static_cast<double>(photons.size());
}

TEST(FocusedFit, HalfOfTheLightPointsToTheLampThatItComesFrom) {
  const Light lamp{{3, 1, 0.5f}, 0.1f};
  float towards_lamp = 0;
  for (const FocusedLobe& lobe : fit(photons_of(lamp, 2048, 1))) {
    if ((lobe.focus - lamp.focus).norm() > 0.2f) continue;
    towards_lamp += lobe.weight;
    EXPECT_LT(lobe.size, 0.2f);
  }
  EXPECT_NEAR(towards_lamp, 0.5f, 0.05f);
}

TEST(FocusedFit, OtherPhotonsAreMuchLikelierThanWithoutPlaces) {
  const Light lamp{{3, 1, 0.5f}, 0.1f};
  const auto photons = photons_of(lamp, 512, 1), others = photons_of(lamp, 4096, 2);
  const FocusedMixture focused(fit(photons));
  const VmfMixture fixed(without_places(photons));
  const double gain =
      mean_log_density(others, [&](const Vec3& p) { return focused.seen_from(p); }) -
      mean_log_density(others, [&](const Vec3&) { return fixed; });
  EXPECT_GT(gain, 0.8);
}

TEST(FocusedFit, LightFromFarAwayOrFromEverywhereHasNoPlaces) {
  EXPECT_TRUE(fit(photons_of({{300, 100, 50}, 10}, 2048, 1)).empty());
  EXPECT_TRUE(fit(photons_of({{0, 0, 0}, 1e6f}, 2048, 1)).empty());
}

TEST(FocusedFit, FewPhotonsGiveNoPlaces) {
  for (uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_TRUE(fit(photons_of({{0, 0, 0}, 1e6f}, 64, seed)).empty()) << seed;
}

TEST(FocusedMixture, FarLobesAreThoseOfDirections) {
  const VmfComponent lobe{1, Vec3(1, 2, -2) / 3, 40};
  const Vec3 w = Vec3(1, 2.2f, -1.9f).normalized();
  const FocusedMixture far(
      std::vector<FocusedLobe>{{1, kFar * lobe.mean, kFar / std::sqrt(lobe.kappa)}});
  EXPECT_NEAR(far.seen_from(Vec3(0.5f, -0.5f, 1)).pdf(w), vmf_pdf(lobe.mean, lobe.kappa, w), 1e-2);
}

TEST(FocusedMixture, ALobeLooksAsWideAsItIsNear) {
  const FocusedMixture mixture(std::vector<FocusedLobe>{{1, {2, 0, 0}, 0.5f}});
  EXPECT_FLOAT_EQ(mixture.seen_from(Vec3::Zero()).component(0).kappa, 16);
  EXPECT_FLOAT_EQ(mixture.seen_from({1, 0, 0}).component(0).kappa, 4);
  const VmfMixture at_focus = mixture.seen_from({2, 0, 0});
  EXPECT_NEAR(at_focus.pdf(Vec3::UnitX()), kInvPi / 4, 1e-6);
}

TEST(FocusedMixture, FromAnywhereItIsADensity) {
  const FocusedMixture mixture(
      std::vector<FocusedLobe>{{0.3f, {2, 0, 0}, 0.5f}, {0.7f, {0, 1, 0}, 2}});
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1.9f, 0, 0), Vec3(0, 1, 0), Vec3(-3, 5, 2)}) {
    const VmfMixture seen = mixture.seen_from(x);
    EXPECT_NEAR(test::integrate_sphere([&](const Vec3& w) { return seen.pdf(w); }), 1, 2e-3);
  }
}

TEST(FocusedMixture, RefusesLobesThatAreNone) {
  const FocusedLobe good{1, {1, 2, 3}, 1};
  EXPECT_TRUE(is_focused_lobe(good));
  for (const float bad : {0.0f, -1.0f, kInfinity, std::nanf(""), 1e20f}) {
    EXPECT_FALSE(is_focused_lobe({bad, good.focus, 1}));
    EXPECT_FALSE(is_focused_lobe({1, good.focus, bad}));
  }
  for (const float bad : {kInfinity, std::nanf(""), -1e20f})
    EXPECT_FALSE(is_focused_lobe({1, {0, bad, 0}, 1}));
}

}  // namespace
}  // namespace waylight
