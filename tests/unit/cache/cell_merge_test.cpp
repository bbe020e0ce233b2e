#include "libguide/cache/cell_merge.h"

#include <gtest/gtest.h>

#include <functional>

#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr uint32_t kPhotons = 100'000;

PhotonStreamInfo floor_info() {
  PhotonStreamInfo info;
  info.scene_bounds = {Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  info.emitted = kPhotons;
  return info;
}

// What light of irradiance 1 a floor gets, [-1, 1]^2 at z = 0: turns direction and power of one of
// its photons, which come from everywhere alike.
using Light = std::function<void(Photon& photon)>;

std::vector<Photon> floor_photons(const Light& light, uint64_t seed = 1) {
  std::vector<Photon> photons;
  for (uint32_t i = 0; i < kPhotons; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec2 place = 2 * sampler.next_2d() - Vec2::Ones();
    const Vec3 up = square_to_cosine_hemisphere(sampler.next_2d());
    photons.push_back(
        {{place.x(), place.y(), 0}, up, Vec3::UnitZ(), Color::Constant(4.0f / kPhotons), 1});
    light(photons.back());
  }
  return photons;
}

void everywhere_alike(Photon& /*photon*/) {}

// Leans to the middle of the floor, by its halves.
void from_the_middle(Photon& photon) {
  const float lean = photon.position.x() < 0 ? 1 : -1;
  photon.direction = (photon.direction + Vec3(lean, 0, 0)).normalized();
  if (photon.direction.z() < 1e-3f) photon.direction = Vec3::UnitZ();
}

void dim_on_the_left(Photon& photon) {
  if (photon.position.x() < 0) photon.power *= 0.3f;
}

GuideCache train(std::span<const Photon> photons, bool merge_alike,
                 CacheTrainSummary* summary = nullptr, GuideCache previous = {}) {
  CacheTrainOptions options;
  options.merge_alike = merge_alike;
  CacheTrainer trainer(options, floor_info(), std::move(previous));
  trainer.consume(photons);
  GuideCache cache = trainer.finish(summary);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  EXPECT_EQ(check_training(cache), "");
  return cache;
}

const CacheCell& cell_at(const GuideCache& cache, float x, float y) {
  const CacheCell* cell = GuideCacheView(cache).query(Vec3(x, y, 0), Vec3::UnitZ());
  EXPECT_NE(cell, nullptr);
  return cell ? *cell : cache.cells[0];
}

bool shares_a_cell(const GuideCache& cache, float left, float right) {
  for (const float y : {-0.9f, -0.5f, -0.1f, 0.3f, 0.7f})
    if (&cell_at(cache, left, y) == &cell_at(cache, right, y)) return true;
  return false;
}

TEST(CellMerge, SiblingsWithTheSameLightMerge) {
  const std::vector<Photon> photons = floor_photons(everywhere_alike);
  CacheTrainSummary summary;
  const GuideCache all = train(photons, false), merged = train(photons, true, &summary);
  EXPECT_GT(all.cells.size(), 100u);
  EXPECT_LT(merged.cells.size(), all.cells.size() / 2);
  EXPECT_EQ(summary.cells_before_merging, all.cells.size());
  EXPECT_EQ(summary.cells, merged.cells.size());
  EXPECT_GT(summary.bytes_saved, 0u);
}

TEST(CellMerge, KeepsIrradianceAndEvidence) {
  const std::vector<Photon> photons = floor_photons(everywhere_alike);
  const GuideCache all = train(photons, false), merged = train(photons, true);
  const auto evidence = [](const GuideCache& cache) {
    double sum = 0;
    for (const CacheCell& cell : cache.cells) sum += cell.effective_samples;
    return sum;
  };
  EXPECT_NEAR(evidence(merged) / evidence(all), 1, 1e-3);
  for (const float x : {-0.8f, -0.3f, 0.2f, 0.6f})
    EXPECT_NEAR(cell_at(merged, x, 0.1f).irradiance, 1, 0.15f);
}

TEST(CellMerge, SiblingsWithLightFromOtherDirectionsDoNot) {
  const GuideCache merged = train(floor_photons(from_the_middle), true);
  EXPECT_FALSE(shares_a_cell(merged, -0.2f, 0.2f));
  EXPECT_LT(merged.cells.size(), 100u);
}

TEST(CellMerge, SiblingsWithOtherIrradianceFromTheSameDirectionsDoNot) {
  const GuideCache merged = train(floor_photons(dim_on_the_left), true);
  EXPECT_FALSE(shares_a_cell(merged, -0.2f, 0.2f));
  for (const float y : {-0.5f, 0.5f}) {
    EXPECT_NEAR(cell_at(merged, -0.5f, y).irradiance, 0.3f, 0.06f);
    EXPECT_NEAR(cell_at(merged, 0.5f, y).irradiance, 1, 0.2f);
  }
}

TEST(CellMerge, CellsReachNoFurtherThanTheyDid) {
  const std::vector<Photon> photons = floor_photons(everywhere_alike);
  const GuideCache all = train(photons, false), merged = train(photons, true);
  const GuideCacheView before(all), after(merged);
  for (uint32_t i = 0; i < 20'000; ++i) {
    Sampler sampler(1, 0, i);
    const Vec2 place = 3 * sampler.next_2d() - Vec2::Constant(1.5f);
    const Vec3 point(place.x(), place.y(), 2 * sampler.next_2d().x() - 1);
    if (before.query(point, Vec3::UnitZ())) continue;
    EXPECT_EQ(after.query(point, Vec3::UnitZ()), nullptr);
  }
}

TEST(CellMerge, ResultDoesNotDependOnThreads) {
  const std::vector<Photon> photons = floor_photons(from_the_middle);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return train(photons, true);
  };
  const GuideCache one = with_threads(1), two = with_threads(2);
  ASSERT_EQ(one.cells.size(), two.cells.size());
  ASSERT_EQ(one.components.size(), two.components.size());
  for (size_t i = 0; i < one.nodes.size(); ++i) EXPECT_EQ(one.nodes[i].split, two.nodes[i].split);
  for (size_t i = 0; i < one.cells.size(); ++i)
    EXPECT_EQ(one.cells[i].irradiance, two.cells[i].irradiance);
  for (size_t i = 0; i < one.components.size(); ++i)
    EXPECT_EQ(one.components[i].mean_x, two.components[i].mean_x);
}

TEST(CellMerge, TrainingGoesOnFromMergedCells) {
  const GuideCache first = train(floor_photons(dim_on_the_left), true);
  const GuideCache second = train(floor_photons(dim_on_the_left, 2), true, nullptr, first);
  EXPECT_NEAR(cell_at(second, -0.5f, 0.3f).irradiance, 0.3f, 0.06f);
  EXPECT_NEAR(cell_at(second, 0.5f, 0.3f).irradiance, 1, 0.2f);
}

}  // namespace
}  // namespace waylight
