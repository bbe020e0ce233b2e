// Trainings that go on from a cache under other circumstances than it was made.

#include <gtest/gtest.h>

#include "common/fog_photons.h"
#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr uint32_t kPhotons = 20'000;

PhotonStreamInfo box_info(const Bounds& bounds = {Vec3(-1, -1, -1), Vec3(1, 1, 1)}) {
  return testing::fog_info(kPhotons, bounds);
}

// On the floor z = 0, for x from `least` to 1, and evenly lit.
std::vector<Photon> floor_photons(float least, uint64_t seed = 1) {
  std::vector<Photon> photons;
  for (uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec2 u = sampler.next_2d();
    const Vec3 place(lerp(least, 1.0f, u.x()), 2 * u.y() - 1, 0);
    const Vec3 up = square_to_cosine_hemisphere(sampler.next_2d());
    photons.push_back({place, up, Vec3::UnitZ(), Color::Ones(), 1});
  }
  return photons;
}

// All over the box, of direct light every second one.
std::vector<MediumPhoton> fog_photons(const Bounds& box, uint64_t seed = 1) {
  std::vector<MediumPhoton> photons;
  for (uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec3 place = testing::place_in(box, sampler);
    photons.push_back({place, square_to_sphere(sampler.next_2d()), Color::Ones(), i % 2});
  }
  return photons;
}

template <typename Photons>
GuideCache train(const Photons& photons, const PhotonStreamInfo& info,
                 const CacheTrainOptions& options, GuideCache previous = {}) {
  CacheTrainer trainer(options, info, std::move(previous));
  trainer.consume(photons);
  GuideCache cache = trainer.finish(nullptr);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  EXPECT_EQ(check_training(cache), "");
  return cache;
}

CacheTrainOptions with_components(int components) {
  CacheTrainOptions options;
  options.components = components;
  return options;
}

TEST(TrainingGoesOn, WithFewerComponentsAlsoWhereNoPhotonCameAgain) {
  const GuideCache before = train(floor_photons(-1), box_info(), with_components(8));
  const GuideCache after = train(floor_photons(0.5f, 2), box_info(), with_components(2), before);
  const auto most = [](const GuideCache& cache) {
    uint32_t most = 0;
    for (const CacheCell& cell : cache.cells) most = std::max(most, cell.component_count);
    return most;
  };
  EXPECT_EQ(most(before), 8u);
  EXPECT_EQ(most(after), 2u);
}

TEST(TrainingGoesOn, WithFewerLobesOfBothKindsOfLightInMedia) {
  const Bounds all = box_info().scene_bounds, part = {Vec3::Constant(0.5f), Vec3::Ones()};
  const GuideCache before = train(fog_photons(all), box_info(), with_components(8));
  const GuideCache after = train(fog_photons(part, 2), box_info(), with_components(2), before);
  ASSERT_GT(before.medium.components.size(), 3 * before.medium.cells.size());
  for (const MediumCell& cell : after.medium.cells) {
    EXPECT_LE(cell.indirect.component_count, 2u);
    EXPECT_LE(cell.direct.component_count, 2u);
  }
}

TEST(TrainingGoesOn, InMediaWhoseVolumeNoFloatHolds) {
  const Bounds vast = {Vec3::Constant(-1e13f), Vec3::Constant(1e13f)};
  const GuideCache before = train(fog_photons(vast), box_info(vast), {});
  CacheTrainOptions options;
  options.merge_alike = true;
  train(fog_photons(vast, 2), box_info(vast), options, before);
}

}  // namespace
}  // namespace waylight
