#include "libguide/cache_reduce.h"

#include <gtest/gtest.h>

#include <cstring>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/directional/vmf_reduction.h"
#include "unit/directional/mixtures.h"
#include "unit/directional/vmf_mixtures.h"

namespace waylight {
namespace {

BrdfCache brdf_cache(int entries) {
  BrdfCache cache;
  for (int i = 0; i < entries; ++i) {
    const auto components = test::random_components(1 + i % 8, i);
    cache.entries.push_back({static_cast<uint32_t>(cache.components.size()),
                             static_cast<uint32_t>(components.size()), 0.1f});
    cache.components.insert(cache.components.end(), components.begin(), components.end());
  }
  return cache;
}

TEST(CacheReduce, EntriesReferToTheirOwnReducedMixture) {
  const BrdfCache before = brdf_cache(40);
  CacheReduceSummary summary;
  const BrdfCache after = reduce(before, {20, 3}, &summary);
  ASSERT_EQ(after.entries.size(), before.entries.size());
  size_t next = 0;
  for (size_t i = 0; i < after.entries.size(); ++i) {
    EXPECT_EQ(after.entries[i].first_component, next);
    EXPECT_LE(after.entries[i].component_count, 3u);
    next += after.entries[i].component_count;
    double mean_before = 0, total = 0, mean_after = 0;
    for (uint32_t k = 0; k < before.entries[i].component_count; ++k) {
      const auto& c = before.components[before.entries[i].first_component + k];
      mean_before += c.weight * c.mean_x, total += c.weight;
    }
    for (uint32_t k = 0; k < after.entries[i].component_count; ++k) {
      const auto& c = after.components[after.entries[i].first_component + k];
      mean_after += c.weight * c.mean_x;
    }
    EXPECT_NEAR(mean_after, mean_before / total, 1e-5);
  }
  EXPECT_EQ(after.components.size(), next);
  EXPECT_EQ(summary.mixtures, 40u);
  EXPECT_DOUBLE_EQ(summary.components_before, 4.5);
  EXPECT_DOUBLE_EQ(summary.components_after, next / 40.0);
}

TEST(CacheReduce, WhatIsKeptByEvidenceGrowsWithIt) {
  GuideCache cache;
  cache.components = test::random_components(8, 1);
  cache.cells.resize(1);
  cache.cells[0].component_count = 8;
  CacheReduceOptions options;
  options.by_evidence = true;
  size_t last = 1;
  for (const float samples : {4.0f, 100.0f, 3000.0f, 1e7f}) {
    cache.cells[0].effective_samples = samples;
    const size_t left = reduce(cache, options, nullptr).components.size();
    EXPECT_GE(left, last) << samples;
    EXPECT_EQ(left == 1, samples < 10);
    last = left;
  }
  EXPECT_GE(last, 7u);
}

TEST(CacheReduce, GuideCacheLosesItsTrainingAndKeepsItsEmptyCells) {
  GuideCache cache;
  const auto components = test::random_components(8, 1);
  cache.components = components;
  cache.statistics.resize(8);
  cache.training.resize(2);
  cache.cells.resize(2);
  cache.cells[1].component_count = 8;
  CacheReduceSummary summary;
  const GuideCache after = reduce(cache, {10, 4}, &summary);
  EXPECT_TRUE(after.statistics.empty());
  EXPECT_TRUE(after.training.empty());
  EXPECT_EQ(after.cells[0].component_count, 0u);
  EXPECT_LE(after.cells[1].component_count, 4u);
  EXPECT_EQ(after.components.size(), after.cells[1].component_count);
  EXPECT_NEAR(after.cells[1].guided_mass, mass_inside(GaussianMixture(after.components)), 1e-6);
  EXPECT_EQ(summary.mixtures, 1u);
}

TEST(CacheReduce, LobesOfMediaAreMergedWithinTheirLight) {
  GuideCache cache;
  MediumCache& m = cache.medium;
  for (int i = 0; i < 10; ++i) {
    MediumCell& cell = m.cells.emplace_back();
    for (MediumLight* light : {&cell.indirect, &cell.direct}) {
      const auto lobes = test::random_lobes(light == &cell.direct ? i % 5 : 8, i);
      light->fluence = 1;
      light->first_component = static_cast<uint32_t>(m.components.size());
      light->component_count = static_cast<uint32_t>(lobes.size());
      m.components.insert(m.components.end(), lobes.begin(), lobes.end());
    }
  }
  m.statistics.resize(m.components.size());
  m.training.resize(10);
  CacheReduceSummary summary;
  const MediumCache after = reduce(cache, {20, 3}, &summary).medium;
  EXPECT_TRUE(after.statistics.empty());
  EXPECT_TRUE(after.training.empty());
  EXPECT_EQ(summary.mixtures, 0u);
  EXPECT_EQ(summary.media.mixtures, 18u);  // two have no direct light
  size_t next = 0;
  for (size_t i = 0; i < 10; ++i)
    for (const auto light : {&MediumCell::indirect, &MediumCell::direct}) {
      const MediumLight& l = after.cells[i].*light;
      EXPECT_EQ(l.first_component, next);
      EXPECT_LE(l.component_count, 3u);
      next += l.component_count;
      const auto kept = reduce_vmf_mixture(
          std::span(m.components)
              .subspan((m.cells[i].*light).first_component, (m.cells[i].*light).component_count),
          20, 3);
      ASSERT_EQ(l.component_count, kept.components.size());
      for (uint32_t k = 0; k < l.component_count; ++k)
        EXPECT_EQ(after.components[l.first_component + k].kappa, kept.components[k].kappa);
    }
  EXPECT_EQ(after.components.size(), next);
}

TEST(CacheReduce, TheSameBytesForAnyNumberOfThreads) {
  const auto bytes = [](int threads) {
    const ThreadLimit limit(threads);
    return reduce(brdf_cache(200), {15, 8}, nullptr).components;
  };
  const auto one = bytes(1), two = bytes(2);
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(std::memcmp(one.data(), two.data(), one.size() * sizeof(one[0])), 0);
}

TEST(CacheReduce, OptionsOutOfRangeNameTheOption) {
  EXPECT_THROW(reduce(BrdfCache{}, {101, 8}, nullptr), Misuse);
  EXPECT_THROW(reduce(BrdfCache{}, {10, 0}, nullptr), Misuse);
  EXPECT_THROW(reduce(BrdfCache{}, {std::nanf(""), 8}, nullptr), Misuse);
}

}  // namespace
}  // namespace waylight
