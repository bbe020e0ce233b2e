#include "libguide/cache/medium_cell_merge.h"

#include <gtest/gtest.h>

#include <functional>

#include "common/fog_photons.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/medium_volume.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/directional/vmf_mixture.h"

namespace waylight {
namespace {

constexpr uint32_t kPhotons = 100'000;

const Bounds kBox = {Vec3(-1, 0, 0), Vec3(1, 1, 0.5f)};  // of volume 1; the medium fills it

// Of one of the photons of even light of fluence 1 from everywhere.
using Light = std::function<void(MediumPhoton& photon)>;

void everywhere_alike(MediumPhoton& /*photon*/) {}

void from_the_middle(MediumPhoton& photon) {
  const float lean = photon.position.x() < 0 ? 2 : -2;
  photon.direction = (photon.direction + Vec3(lean, 0, 0)).normalized();
}

void dim_on_the_left(MediumPhoton& photon) {
  if (photon.position.x() < 0) photon.weight *= 0.3f;
}

void direct_on_the_right(MediumPhoton& photon) {
  if (photon.position.x() > 0) photon.path_depth = 0;
}

std::vector<MediumPhoton> fog_photons(const Light& light, uint64_t seed = 1) {
  std::vector<MediumPhoton> photons;
  for (uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec3 place = testing::place_in(kBox, sampler);
    photons.push_back(
        {place, square_to_sphere(sampler.next_2d()), Color::Constant(1.0f / kPhotons), 1});
    light(photons.back());
  }
  return photons;
}

GuideCache train(std::span<const MediumPhoton> photons, bool merge_alike,
                 CacheTrainSummary* summary = nullptr, GuideCache previous = {}) {
  CacheTrainOptions options;
  options.medium_photons_per_cell = 500;
  options.merge_alike = merge_alike;
  PhotonStreamInfo info;
  info.scene_bounds = kBox;
  info.emitted = kPhotons;
  info.media = true;
  CacheTrainer trainer(options, info, std::move(previous));
  trainer.consume(photons);
  GuideCache cache = trainer.finish(summary);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  EXPECT_EQ(check_training(cache), "");
  return cache;
}

const MediumCell& cell_at(const GuideCache& cache, const Vec3& x) {
  return *MediumCacheView(cache.medium).query(x);
}

// Whether any cell lies on both sides of the middle.
bool spans_the_middle(const GuideCache& cache) {
  for (const float y : {0.1f, 0.4f, 0.7f, 0.9f})
    for (const float z : {0.1f, 0.3f})
      if (&cell_at(cache, {-0.2f, y, z}) == &cell_at(cache, {0.2f, y, z})) return true;
  return false;
}

TEST(MediumCellMerge, SiblingsWithTheSameLightMerge) {
  const std::vector<MediumPhoton> photons = fog_photons(everywhere_alike);
  CacheTrainSummary summary;
  const GuideCache all = train(photons, false), merged = train(photons, true, &summary);
  EXPECT_GT(all.medium.cells.size(), 100u);
  EXPECT_LT(merged.medium.cells.size(), all.medium.cells.size() / 2);
  EXPECT_EQ(summary.media.cells_before_merging, all.medium.cells.size());
  EXPECT_EQ(summary.media.cells, merged.medium.cells.size());
}

TEST(MediumCellMerge, KeepsFluenceAndEvidence) {
  const std::vector<MediumPhoton> photons = fog_photons(everywhere_alike);
  const GuideCache all = train(photons, false), merged = train(photons, true);
  const auto evidence = [](const GuideCache& cache) {
    double sum = 0;
    for (const MediumCell& cell : cache.medium.cells) sum += cell.indirect.effective_samples;
    return sum;
  };
  EXPECT_NEAR(evidence(merged) / evidence(all), 1, 1e-3);
  for (const float x : {-0.8f, -0.3f, 0.2f, 0.6f})
    EXPECT_NEAR(cell_at(merged, {x, 0.5f, 0.2f}).indirect.fluence, 1, 0.15f);
}

TEST(MediumCellMerge, SiblingsWithLightFromOtherDirectionsDoNot) {
  const GuideCache merged = train(fog_photons(from_the_middle), true);
  EXPECT_FALSE(spans_the_middle(merged));
  EXPECT_LT(merged.medium.cells.size(), 100u);
}

TEST(MediumCellMerge, SiblingsWithOtherFluenceDoNot) {
  const GuideCache merged = train(fog_photons(dim_on_the_left), true);
  EXPECT_FALSE(spans_the_middle(merged));
  for (const float y : {0.3f, 0.8f}) {
    EXPECT_NEAR(cell_at(merged, {-0.5f, y, 0.2f}).indirect.fluence, 0.3f, 0.06f);
    EXPECT_NEAR(cell_at(merged, {0.5f, y, 0.2f}).indirect.fluence, 1, 0.15f);
  }
}

TEST(MediumCellMerge, SiblingsWithOtherDirectLightDoNot) {
  EXPECT_FALSE(spans_the_middle(train(fog_photons(direct_on_the_right), true)));
}

TEST(MediumCellMerge, ResultDoesNotDependOnThreads) {
  const std::vector<MediumPhoton> photons = fog_photons(from_the_middle);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return train(photons, true);
  };
  const GuideCache one = with_threads(1), two = with_threads(2);
  ASSERT_EQ(one.medium.cells.size(), two.medium.cells.size());
  ASSERT_EQ(one.medium.components.size(), two.medium.components.size());
  for (size_t i = 0; i < one.medium.cells.size(); ++i)
    EXPECT_EQ(one.medium.cells[i].indirect.fluence, two.medium.cells[i].indirect.fluence);
  for (size_t i = 0; i < one.medium.components.size(); ++i)
    EXPECT_EQ(one.medium.components[i].kappa, two.medium.components[i].kappa);
}

TEST(MediumCellMerge, TrainingGoesOnFromMergedCells) {
  const GuideCache first = train(fog_photons(dim_on_the_left), true);
  const GuideCache second = train(fog_photons(dim_on_the_left, 2), true, nullptr, first);
  EXPECT_NEAR(cell_at(second, {-0.5f, 0.3f, 0.2f}).indirect.fluence, 0.3f, 0.06f);
  EXPECT_NEAR(cell_at(second, {0.5f, 0.3f, 0.2f}).indirect.fluence, 1, 0.15f);
}

TEST(MediumVolume, PartsOfBothHalvesAreTheirsByPlace) {
  const Bounds lower = {Vec3(0, 0, 0), Vec3(1, 4, 4)}, upper = {Vec3(1, 0, 0), Vec3(4, 4, 4)};
  const uint64_t all = ~uint64_t{0}, first_quarter = 0x1111111111111111u;
  EXPECT_EQ(parts_of_both(lower, all, upper, all), all);
  EXPECT_EQ(parts_of_both(lower, all, upper, 0), first_quarter);
  EXPECT_EQ(parts_of_both(lower, 0, upper, all), all & ~first_quarter);
}

}  // namespace
}  // namespace waylight
