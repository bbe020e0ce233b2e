// Trainings that go on from a cache under other circumstances than it was made.

#include <gtest/gtest.h>

#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr uint32_t kPhotons = 20'000;

PhotonStreamInfo box_info(const Bounds& bounds = {Vec3(-1, -1, -1), Vec3(1, 1, 1)}) {
  PhotonStreamInfo info;
  info.scene_bounds = bounds;
  info.emitted = kPhotons;
  info.media = true;
  return info;
}

// All over the box, of direct light every second one.
std::vector<MediumPhoton> fog_photons(const Bounds& box, uint64_t seed = 1) {
  std::vector<MediumPhoton> photons;
  for (uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec2 u = sampler.next_2d();
    const Vec3 place(u.x(), u.y(), sampler.next());
    photons.push_back({box.min + place.cwiseProduct(box.max - box.min),
                       square_to_sphere(sampler.next_2d()), Color::Ones(), i % 2});
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

TEST(TrainingGoesOn, InMediaWhoseVolumeNoFloatHolds) {
  const Bounds vast = {Vec3::Constant(-1e13f), Vec3::Constant(1e13f)};
  const GuideCache before = train(fog_photons(vast), box_info(vast), {});
  CacheTrainOptions options;
  options.merge_alike = true;
  train(fog_photons(vast, 2), box_info(vast), options, before);
}

}  // namespace
}  // namespace waylight
