// Training of the places that light in media comes from.

#include <gtest/gtest.h>

#include "common/fog_photons.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/directional/focused_mixture.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

const Bounds kBox = {Vec3::Constant(-1), Vec3::Constant(1)};
const Vec3 kLamp(0, 1.5f, 0);  // above a box of fog of two units a side

// Photons anywhere in the box, of which every other one comes from the lamp, by way of its glass.
std::vector<MediumPhoton> light_of_a_lamp(int count, uint64_t seed = 1) {
  std::vector<MediumPhoton> photons;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec3 p = testing::place_in(kBox, sampler);
    const Vec3 w = square_to_sphere(sampler.next_2d());
    photons.push_back(
        {p, i % 2 ? (kLamp + 0.05f * w - p).normalized() : w, Color::Constant(1.0f / count), 1});
  }
  return photons;
}

GuideCache train(const std::vector<MediumPhoton>& photons, bool again, GuideCache previous = {},
                 CacheTrainSummary* summary = nullptr) {
  CacheTrainOptions options;
  options.medium_photons_per_cell = 1000;
  CacheTrainer trainer(options, testing::fog_info(1000, kBox), std::move(previous));
  trainer.consume(photons);
  if (again) trainer.refit(photons);
  GuideCache cache = trainer.finish(summary);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  EXPECT_EQ(check_training(cache), "");
  return cache;
}

TEST(FocusedTraining, CellsPointToTheLampFromEverywhereInThem) {
  CacheTrainSummary summary;
  const GuideCache cache = train(light_of_a_lamp(16384), true, {}, &summary);
  const MediumCacheView view(cache.medium);
  EXPECT_EQ(summary.media.cells_with_focus, view.cells.size());
  for (const Vec3& x : {Vec3(0.9f, -0.9f, 0.3f), Vec3(-0.2f, 0.8f, 0.9f), Vec3(0, -0.5f, -0.5f)}) {
    const auto cell = static_cast<uint32_t>(view.query(x) - view.cells.data());
    ASSERT_FALSE(view.focused(cell).empty());
    const Vec3 to_lamp = (kLamp - x).normalized();
    const float focused = FocusedMixture(view.focused(cell)).seen_from(x).pdf(to_lamp);
    EXPECT_GT(focused, 3 * VmfMixture(view.lobes(view.cells[cell].indirect)).pdf(to_lamp));
  }
}

TEST(FocusedTraining, PhotonsThatAreReadOnceGiveNoPlaces) {
  EXPECT_TRUE(train(light_of_a_lamp(16384), false).medium.focused_cells.empty());
}

TEST(FocusedTraining, TheRestOfTheCacheIsAsWithoutPlaces) {
  const MediumCache with = train(light_of_a_lamp(16384), true).medium;
  const MediumCache without = train(light_of_a_lamp(16384), false).medium;
  ASSERT_EQ(with.components.size(), without.components.size());
  for (size_t k = 0; k < with.components.size(); ++k)
    EXPECT_EQ(with.components[k].kappa, without.components[k].kappa);
}

TEST(FocusedTraining, DoesNotDependOnThreads) {
  const auto trained_by = [](int threads) {
    const ThreadLimit limit(threads);
    return train(light_of_a_lamp(16384), true).medium;
  };
  const MediumCache one = trained_by(1), two = trained_by(3);
  ASSERT_EQ(one.focused_lobes.size(), two.focused_lobes.size());
  for (size_t i = 0; i < one.focused_lobes.size(); ++i)
    EXPECT_EQ(one.focused_lobes[i].focus, two.focused_lobes[i].focus);
}

TEST(FocusedTraining, PlacesLastUntilTheCellLearnsAnew) {
  const GuideCache first = train(light_of_a_lamp(16384), true);
  EXPECT_EQ(train({}, false, first).medium.focused_lobes.size(), first.medium.focused_lobes.size());
  EXPECT_TRUE(train(light_of_a_lamp(65536, 2), false, first).medium.focused_cells.empty());
  EXPECT_FALSE(train(light_of_a_lamp(16384, 2), true, first).medium.focused_cells.empty());
}

}  // namespace
}  // namespace waylight
