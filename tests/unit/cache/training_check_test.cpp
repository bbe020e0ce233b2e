#include "libguide/cache/training_check.h"

#include <gtest/gtest.h>

#include <functional>

namespace waylight {
namespace {

// One cell of surfaces and one of a medium, of one lobe each.
GuideCache trained() {
  GuideCache cache;
  cache.photons = cache.medium.photons = 1000;
  CacheCell& cell = cache.cells.emplace_back();
  cell.component_count = 1, cell.photon_count = 100;
  CellTraining& t = cache.training.emplace_back();
  t.step = t.samples = 1, t.weight_sum = 1;
  cache.components = {{1, 0.5f, 0, 0.1f, 0, 0.1f}};
  cache.statistics = {{1, 0.5f, 0, 0.1f, 0, 0.1f}};
  MediumCell& fog = cache.medium.cells.emplace_back();
  fog.indirect.component_count = 1, fog.indirect.photon_count = 100;
  MediumTraining& m = cache.medium.training.emplace_back();
  m.indirect.step = m.indirect.samples = 1, m.indirect.weight_sum = 1;
  cache.medium.components = {{1, Vec3::UnitZ(), 10}};
  cache.medium.statistics = {{1, Vec3(0, 0, 0.9f)}};
  return cache;
}

TEST(TrainingCheck, AcceptsStatisticsOfLobes) {
  EXPECT_EQ(check_training(trained()), "");
  GuideCache at_the_bounds = trained();
  at_the_bounds.statistics[0] = {1.0005f, -1.42f, 1.42f, 20, -3, 0};
  at_the_bounds.medium.statistics[0] = {1.0005f, Vec3(0, 0, -1.0006f)};
  EXPECT_EQ(check_training(at_the_bounds), "");
}

TEST(TrainingCheck, RefusesStatisticsThatNoLobeHas) {
  using Damage = std::function<void(ComponentStatistics&)>;
  for (const Damage& damage : std::vector<Damage>{
           [](auto& s) { s.s0 = 1e30f; }, [](auto& s) { s.s0 = -1; },
           [](auto& s) { s.s1_x = 3e6f; }, [](auto& s) { s.s1_y = std::nanf(""); },
           [](auto& s) { s.s2_xx = -1; }, [](auto& s) { s.s2_xx = 3e38f; },
           [](auto& s) { s.s2_xy = -3e38f; }, [](auto& s) { s.s2_yy = kInfinity; }}) {
    GuideCache cache = trained();
    damage(cache.statistics[0]);
    EXPECT_EQ(check_training(cache), "statistics 0 are those of no lobe");
  }
}

TEST(TrainingCheck, RefusesStatisticsThatNoLobeOfMediaHas) {
  using Damage = std::function<void(VmfStatistics&)>;
  for (const Damage& damage : std::vector<Damage>{
           [](auto& s) { s.s0 = 1e30f; }, [](auto& s) { s.s0 = 0.5f; },
           [](auto& s) { s.s1.x() = std::nanf(""); }, [](auto& s) { s.s1.y() = -3e38f; }}) {
    GuideCache cache = trained();
    damage(cache.medium.statistics[0]);
    EXPECT_EQ(check_training(cache), "media: statistics 0 are those of no lobe");
  }
}

}  // namespace
}  // namespace waylight
