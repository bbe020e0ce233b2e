#include "libguide/cache_train.h"

#include <gtest/gtest.h>

#include <atomic>

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/scene/cone.h"
#include "libguide/spatial/escape_map.h"

namespace waylight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kLampSide = 0.5f;  // a square lamp of radiance 1, one above the floor, facing down
constexpr float kFloor = 1;        // the floor is [-1, 1]^2 at z = 0

PhotonStreamInfo floor_info(uint64_t emitted) {
  PhotonStreamInfo info;
  info.scene_bounds = {Vec3(-kFloor, -kFloor, -1), Vec3(kFloor, kFloor, 1)};
  info.emitted = emitted;
  return info;
}

std::vector<Photon> floor_photons(uint32_t emitted, uint64_t seed = 1) {
  std::vector<Photon> photons;
  const float power = kPi * sqr(kLampSide) / static_cast<float>(emitted);
  for (uint32_t i = 0; i < emitted; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec2 place = (sampler.next_2d() - Vec2::Constant(0.5f)) * kLampSide;
    const Vec3 up = square_to_cosine_hemisphere(sampler.next_2d());
    if (up.z() < 1e-3f) continue;
    const Vec3 hit(place.x() - up.x() / up.z(), place.y() - up.y() / up.z(), 0);
    if (hit.cwiseAbs().maxCoeff() > kFloor) continue;
    photons.push_back({hit, up, Vec3::UnitZ(), Color::Constant(power), 1});
  }
  return photons;
}

// Li cos over the disk of the floor at x.
float lamp_cosine(const Vec3& x, const Vec3& wi) {
  if (wi.z() <= 0) return 0;
  const Vec3 hit = x + wi / wi.z();
  return std::max(std::abs(hit.x()), std::abs(hit.y())) < kLampSide / 2 ? wi.z() : 0;
}

GuideCache train(std::span<const Photon> photons, const PhotonStreamInfo& info,
                 const CacheTrainOptions& options = {}, CacheTrainSummary* summary = nullptr,
                 GuideCache previous = {}) {
  CacheTrainer trainer(options, info, std::move(previous));
  trainer.consume(photons);
  GuideCache cache = trainer.finish(summary);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  return cache;
}

struct Comparison {
  double distance = 0;          // total variation between mixture and truth, [0, 1]
  double irradiance_ratio = 0;  // of the cache to the truth
};

// By midpoint quadrature over the square around the disk.
Comparison compare_with_lamp(const GuideCache& cache, const Vec3& x) {
  const GuideCacheView view(cache);
  const CacheCell* cell = view.query(x, Vec3::UnitZ());
  EXPECT_NE(cell, nullptr);
  if (!cell) return {1, 0};
  constexpr int kSide = 128;
  const float area = 4.0f / (kSide * kSide);
  const GaussianMixture mixture = view.mixture(*cell);
  std::vector<float> truth, found;
  double total = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec2 y((i % kSide + 0.5f) / kSide * 2 - 1, (i / kSide + 0.5f) / kSide * 2 - 1);
    const Vec3 wi = Frame(cell->normal).to_world(disk_to_direction(y));
    truth.push_back(y.squaredNorm() < 1 ? lamp_cosine(x, wi) : 0.0f);
    found.push_back(mixture.pdf(y));
    total += truth.back() * area;
  }
  Comparison result;
  for (size_t i = 0; i < truth.size(); ++i)
    result.distance += 0.5 * std::abs(truth[i] / total - found[i]) * area;
  result.irradiance_ratio = cell->irradiance / (total * kSteradianPerDiskArea);
  return result;
}

Comparison mean_comparison(const GuideCache& cache) {
  constexpr int kPlaces = 32;
  Comparison mean;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec2 u = Sampler(7, 0, i).next_2d() * 2 - Vec2::Ones();
    const Comparison c = compare_with_lamp(cache, Vec3(0.9f * u.x(), 0.9f * u.y(), 0));
    mean.distance += c.distance / kPlaces;
    mean.irradiance_ratio += c.irradiance_ratio / kPlaces;
  }
  return mean;
}

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

// All fields of a cache, without the padding between them.
std::string bytes_of(const GuideCache& cache) {
  std::string bytes;
  append(bytes, cache.photons);
  for (const CacheNode& node : cache.nodes) append(bytes, node);
  for (const CacheCell& cell : cache.cells) append(bytes, cell);
  for (const GaussianComponent& component : cache.components) append(bytes, component);
  for (const ComponentStatistics& statistics : cache.statistics) append(bytes, statistics);
  for (const CellTraining& t : cache.training) {
    for (const Vec3* v :
         {&t.position_mean, &t.position_m2, &t.position_cross, &t.normal_mean, &t.normal_m2})
      append(bytes, *v);
    for (double v : {t.flux, t.born, t.weight_sum, t.weight_sum2}) append(bytes, v);
    for (float v : {t.count, t.inherited_area, t.step, t.samples}) append(bytes, v);
  }
  return bytes;
}

Photon photon_from(const Vec3& direction, float power = 1) {
  return {Vec3::Zero(), direction.normalized(), Vec3::UnitZ(), Color::Constant(power), 1};
}

// Photons from a small cone about an axis, spread over [-0.5, 0.5]^2 of the plane of the normal.
std::vector<Photon> beam(int count, const Vec3& axis, const Vec3& normal, float power = 1) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(3, 0, i);
    const Vec2 u = sampler.next_2d() - Vec2::Constant(0.5f);
    const Vec3 wi =
        Frame(axis.normalized()).to_world(square_to_cone_of_height(sampler.next_2d(), 0.01f));
    photons.push_back(
        {Frame(normal).to_world(Vec3(u.x(), u.y(), 0)), wi, normal, Color::Constant(power), 1});
  }
  return photons;
}

float density(const GuideCache& cache, const Vec3& x, const Vec3& normal, const Vec3& wi) {
  const GuideCacheView view(cache);
  const CacheCell* cell = view.query(x, normal);
  if (!cell) return 0;
  return view.mixture(*cell).pdf(direction_to_disk(Frame(cell->normal).to_local(wi.normalized())));
}

TEST(CacheTrain, LearnsTheIncidentLightOfALamp) {
  CacheTrainOptions options;
  options.photons_per_cell = 1000;
  CacheTrainSummary summary;
  const GuideCache cache = train(floor_photons(600'000), floor_info(600'000), options, &summary);
  const Comparison mean = mean_comparison(cache);
  EXPECT_LT(mean.distance, 0.30);  // of a box by Gaussians alone: about 0.15
  EXPECT_NEAR(mean.irradiance_ratio, 1, 0.05);
  EXPECT_EQ(summary.cells_with_mixture, summary.cells);
  EXPECT_GT(summary.cells, 60u);
  EXPECT_LT(summary.lost_mass, 0.01);
  EXPECT_EQ(summary.rejected + summary.weights_capped, 0u);
}

TEST(CacheTrain, MorePhotonsFitBetter) {
  const Comparison few = mean_comparison(train(floor_photons(10'000), floor_info(10'000)));
  const Comparison many = mean_comparison(train(floor_photons(300'000), floor_info(300'000)));
  EXPECT_LT(many.distance, 0.7 * few.distance);
}

TEST(CacheTrain, ResultDoesNotDependOnHowTheStreamIsCut) {
  const std::vector<Photon> photons = floor_photons(60'000);
  const std::string whole = bytes_of(train(photons, floor_info(60'000)));
  for (size_t cut : {1, 777, 16384}) {
    CacheTrainer trainer({}, floor_info(60'000));
    for (size_t begin = 0; begin < photons.size(); begin += cut)
      trainer.consume(std::span(photons).subspan(begin, std::min(cut, photons.size() - begin)));
    EXPECT_EQ(bytes_of(trainer.finish(nullptr)), whole) << "pieces of " << cut;
  }
}

TEST(CacheTrain, ResultDoesNotDependOnThreads) {
  const std::vector<Photon> photons = floor_photons(200'000);
  std::string bytes[2];
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    bytes[threads - 1] = bytes_of(train(photons, floor_info(200'000)));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

GuideCache train_and_refit(std::span<const Photon> photons, uint64_t emitted, size_t cut,
                           CacheTrainSummary* summary = nullptr) {
  CacheTrainer trainer({}, floor_info(emitted));
  trainer.consume(photons);
  for (size_t begin = 0; begin < photons.size(); begin += cut)
    trainer.refit(photons.subspan(begin, std::min(cut, photons.size() - begin)));
  GuideCache cache = trainer.finish(summary);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  return cache;
}

TEST(CacheTrain, RefittingDoesNotDependOnThreadsOrOnHowTheStreamIsCut) {
  const std::vector<Photon> photons = floor_photons(60'000);
  const std::string whole = bytes_of(train_and_refit(photons, 60'000, photons.size()));
  EXPECT_NE(whole, bytes_of(train(photons, floor_info(60'000))));
  const ThreadLimit limit(1);
  EXPECT_EQ(bytes_of(train_and_refit(photons, 60'000, 777)), whole);
}

TEST(CacheTrain, RefittedMixturesAreCloserToTheLight) {
  const std::vector<Photon> photons = floor_photons(100'000);
  CacheTrainSummary summary;
  const GuideCache refitted = train_and_refit(photons, 100'000, photons.size(), &summary);
  EXPECT_GT(summary.mixtures_refitted, summary.cells * 9 / 10);
  const double once = mean_comparison(train(photons, floor_info(100'000))).distance;
  EXPECT_LT(mean_comparison(refitted).distance, 0.97 * once);
}

TEST(CacheTrain, RefittedCellsOwnTheEvidenceOfTheirPhotonsBoundedAsInTraining) {
  std::vector<Photon> photons = floor_photons(100'000);
  photons[photons.size() / 2].power *= 1e5f;
  const GuideCache cache = train_and_refit(photons, 100'000, photons.size());
  double sum = 0;
  for (const CacheCell& cell : cache.cells) {
    EXPECT_GT(cell.effective_samples, 0.1f * cell.photon_count);
    sum += cell.photon_count;
  }
  EXPECT_NEAR(sum / static_cast<double>(photons.size()), 1, 0.05);
}

TEST(CacheTrain, RefittingKeepsTheEvidenceOfEarlierStreams) {
  const std::vector<Photon> first = floor_photons(50'000, 1), second = floor_photons(50'000, 2);
  CacheTrainer trainer({}, floor_info(50'000), train(first, floor_info(50'000)));
  trainer.consume(second);
  trainer.refit(second);
  CacheTrainSummary summary;
  const GuideCache cache = trainer.finish(&summary);
  EXPECT_GT(summary.mixtures_refitted, summary.cells * 3 / 4);
  double sum = 0;
  for (const CacheCell& cell : cache.cells) sum += cell.photon_count;
  EXPECT_GT(sum, 1.3 * static_cast<double>(second.size()));
  for (const CellTraining& t : cache.training) EXPECT_GE(t.step, 1);
}

TEST(CacheTrain, RefittingTellsHowFarItIsAndStops) {
  const std::vector<Photon> photons = floor_photons(60'000);
  std::atomic<bool> stop{false};
  RunControl control;
  double told = 0;
  control.stop = &stop;
  control.on_progress = [&](double done, double, const char*) { told = done, stop = true; };
  CacheTrainer trainer({}, floor_info(60'000));
  trainer.consume(photons);
  trainer.refit(photons);
  EXPECT_TRUE(trainer.finish(nullptr, control).cells.empty());
  EXPECT_GT(told, 0);
}

TEST(CacheTrain, RefusesPhotonsAfterTheSameAgain) {
  const std::vector<Photon> photons = floor_photons(1000);
  CacheTrainer trainer({}, floor_info(1000));
  trainer.consume(photons);
  trainer.refit(photons);
  EXPECT_THROW(trainer.consume(photons), Error);
}

TEST(CacheTrain, GoingOnIsAsGoodAsTrainingInOneGo) {
  const std::vector<Photon> first = floor_photons(150'000, 1), second = floor_photons(150'000, 2);
  std::vector<Photon> all = first;
  all.insert(all.end(), second.begin(), second.end());
  for (Photon& p : all) p.power *= 0.5f;  // one stream of twice as many particles
  const GuideCache whole = train(all, floor_info(300'000));
  const GuideCache halves =
      train(second, floor_info(150'000), {}, nullptr, train(first, floor_info(150'000)));
  EXPECT_EQ(halves.passes, 2u);
  EXPECT_EQ(halves.emitted, whole.emitted);
  EXPECT_EQ(halves.photons, whole.photons);
  EXPECT_NEAR(static_cast<double>(halves.cells.size()) / whole.cells.size(), 1, 0.15);
  const Comparison a = mean_comparison(whole), b = mean_comparison(halves);
  EXPECT_NEAR(a.distance, b.distance, 0.02);
  EXPECT_NEAR(a.irradiance_ratio, b.irradiance_ratio, 0.02);
}

TEST(CacheTrain, StreamsOfDifferentLengthCountByTheirParticles) {
  const GuideCache first = train(floor_photons(200'000, 1), floor_info(200'000));
  const GuideCache both = train(floor_photons(20'000, 2), floor_info(20'000), {}, nullptr, first);
  EXPECT_NEAR(mean_comparison(both).irradiance_ratio, 1, 0.06);
}

// The second stream has ten times the photons per particle, as guided ones would. A floor lit
// evenly: cells of any size have one irradiance.
TEST(CacheTrain, StreamsOfOtherPhotonsPerParticleAgreeOnTheIrradiance) {
  const auto even_photons = [](uint32_t count, float flux, uint64_t seed) {
    std::vector<Photon> photons;
    for (uint32_t i = 0; i < count; ++i) {
      Sampler sampler(seed, 0, i);
      const Vec2 place = 2 * sampler.next_2d() - Vec2::Ones();
      photons.push_back({Vec3(place.x(), place.y(), 0),
                         square_to_cosine_hemisphere(sampler.next_2d()), Vec3::UnitZ(),
                         Color::Constant(flux / count), 1});
    }
    return photons;
  };
  GuideCache cache = train(even_photons(20'000, 4, 1), floor_info(20'000));
  cache = train(even_photons(200'000, 4, 2), floor_info(20'000), {}, nullptr, std::move(cache));
  ASSERT_GT(cache.cells.size(), 100u);
  double sum = 0;
  for (const CacheCell& cell : cache.cells) {
    EXPECT_NEAR(cell.irradiance, 1, 0.35);
    sum += cell.irradiance / cache.cells.size();
  }
  EXPECT_NEAR(sum, 1, 0.05);
}

TEST(CacheTrain, FewHeavyPhotonsOfAnEarlierStreamDoNotOutweighAllEvidenceToCome) {
  CacheTrainOptions options;
  options.photons_per_cell = 100'000;
  GuideCache cache = train(floor_photons(100), floor_info(100), options);
  ASSERT_GT(cache.cells[0].component_count, 0u);
  cache = train(floor_photons(20'000, 2), floor_info(20), options, nullptr, std::move(cache));
  EXPECT_GT(cache.cells[0].effective_samples, 5000);
}

TEST(CacheTrain, RefusesToMixRadianceAndImportance) {
  PhotonStreamInfo importance = floor_info(1000);
  importance.quantity = Quantity::importance;
  GuideCache cache = train(floor_photons(1000), floor_info(1000));
  EXPECT_EQ(cache.quantity, Quantity::radiance);
  EXPECT_THROW(CacheTrainer({}, importance, std::move(cache)), Error);
}

TEST(CacheTrain, ImportonsStraightFromTheCameraCountInNothing) {
  PhotonStreamInfo info = floor_info(20'000);
  info.quantity = Quantity::importance;
  const std::vector<Photon> importons = floor_photons(20'000);
  const size_t count = importons.size();
  GuideCache expected = train(importons, info);
  std::vector<Photon> mixed;
  for (const Photon& p : importons) {
    mixed.insert(mixed.end(), 2, p);
    mixed.back().path_depth = 0;
  }
  CacheTrainSummary summary;
  const GuideCache cache = train(mixed, info, {}, &summary);
  EXPECT_EQ(summary.dropped_direct, count);
  EXPECT_EQ(cache.quantity, Quantity::importance);
  const Vec3 x(0.6f, 0.5f, 0);
  EXPECT_NEAR(compare_with_lamp(cache, x).irradiance_ratio,
              compare_with_lamp(expected, x).irradiance_ratio, 0.5)
      << "counted, they would double it";
}

TEST(CacheTrain, EscapesOfTwoStreamsAreTheirMeanByParticles) {
  PhotonStreamInfo info = floor_info(1000);
  info.quantity = Quantity::importance;
  const auto trained = [&](float power, uint64_t emitted, GuideCache previous) {
    info.emitted = emitted;
    CacheTrainer trainer({}, info, std::move(previous));
    const std::vector<Escape> escapes = {
        {Vec3(0.1f, 0.2f, 0), Vec3::UnitZ(), Color::Constant(power), 1},
        {Vec3::Zero(), Vec3::UnitX(), Color::Ones(), 0}};
    trainer.consume(escapes);
    return trainer.finish(nullptr);
  };
  GuideCache cache = trained(4, 1000, {});
  ASSERT_EQ(cache.escape_bins, std::vector<uint32_t>{EscapeMap::bin(Vec3::UnitZ())});
  cache = trained(8, 3000, std::move(cache));
  float sum = 0;
  for (const float w : cache.escape_weights) sum += w;
  EXPECT_FLOAT_EQ(sum, 7);
}

TEST(CacheTrain, RefusesACacheWithoutStatistics) {
  GuideCache reduced = train(floor_photons(5'000), floor_info(5'000));
  reduced.statistics.clear();
  reduced.training.clear();
  EXPECT_THROW(CacheTrainer({}, floor_info(1), reduced), Error);
}

TEST(CacheTrain, RefusesADamagedCache) {
  const GuideCache good = train(floor_photons(20'000), floor_info(20'000));
  const auto refused = [&](auto&& damage) {
    GuideCache cache = good;
    damage(cache);
    EXPECT_THROW(CacheTrainer({}, floor_info(1), cache), Error);
  };
  EXPECT_NO_THROW(CacheTrainer({}, floor_info(1), good));
  refused([](GuideCache& c) { c.nodes[0].child = 0; });
  refused([](GuideCache& c) { c.statistics[0].s2_xx = kNan; });
  refused([](GuideCache& c) { c.training[0].weight_sum = -1; });
  refused([](GuideCache& c) { c.training[0].position_m2.y() = kNan; });
  refused([](GuideCache& c) { c.training[0].samples = 0; });
  refused([](GuideCache& c) { c.training[0].born = 1e12; });
}

TEST(CacheTrain, RefusesAStreamThatSaysTooLittle) {
  EXPECT_THROW(CacheTrainer({}, floor_info(0)), Error);
  PhotonStreamInfo unbounded;
  unbounded.emitted = 1;
  EXPECT_THROW(CacheTrainer({}, unbounded), Error);
}

TEST(CacheTrain, NothingIsTrainedAfterTheEnd) {
  CacheTrainer trainer({}, floor_info(1));
  EXPECT_TRUE(trainer.finish(nullptr).components.empty());
  EXPECT_THROW(trainer.finish(nullptr), Error);
}

TEST(CacheTrain, CountsAndRefusesPhotonsThatAreNone) {
  std::vector<Photon> photons = beam(1000, Vec3::UnitZ(), Vec3::UnitZ());
  const GuideCache clean = train(photons, floor_info(10));
  const auto bad = [&](auto&& damage) {
    photons.push_back(photons.front());
    damage(photons.back());
  };
  bad([](Photon& p) { p.position.x() = kNan; });
  bad([](Photon& p) { p.position.y() = -2; });
  bad([](Photon& p) { p.position.z() = kInfinity; });
  bad([](Photon& p) { p.normal = Vec3::Zero(); });
  bad([](Photon& p) { p.normal.z() = kNan; });
  bad([](Photon& p) { p.direction *= 2; });
  bad([](Photon& p) { p.power = Color::Zero(); });
  bad([](Photon& p) { p.power.x() = kNan; });
  bad([](Photon& p) { p.power.y() = kInfinity; });
  bad([](Photon& p) { p.power.z() = -1; });
  bad([](Photon& p) { p.power = Color::Constant(1e37f); });
  CacheTrainSummary summary;
  const GuideCache cache = train(photons, floor_info(10), {}, &summary);
  EXPECT_EQ(summary.photons, 1011u);
  EXPECT_EQ(summary.rejected, 11u);
  ASSERT_EQ(cache.components.size(), clean.components.size());
  for (size_t i = 0; i < cache.components.size(); ++i)
    EXPECT_EQ(cache.components[i].mean_x, clean.components[i].mean_x);
  EXPECT_EQ(cache.training[0].flux, clean.training[0].flux);
}

TEST(CacheTrain, PhotonsInOnePlaceMakeOneCell) {
  CacheTrainSummary summary;
  const std::vector<Photon> photons(50'000, photon_from(Vec3(0.3f, 0, 1)));
  const GuideCache cache = train(photons, floor_info(50'000), {}, &summary);
  EXPECT_EQ(summary.cells, 1u);
  EXPECT_GT(density(cache, Vec3::Zero(), Vec3::UnitZ(), Vec3(0.3f, 0, 1)), 10);
}

TEST(CacheTrain, SeparatesTheSidesOfAThinWall) {
  const Vec3 front = Vec3::UnitX(), back = -Vec3::UnitX();
  const Vec3 from_above = Vec3(1, 0, 1), from_below = Vec3(-1, 0, -1);
  std::vector<Photon> photons;
  const std::vector<Photon> a = beam(20'000, from_above, front), b = beam(20'000, from_below, back);
  for (size_t i = 0; i < a.size(); ++i) photons.insert(photons.end(), {a[i], b[i]});
  const GuideCache cache = train(photons, floor_info(1000));
  EXPECT_GT(density(cache, Vec3::Zero(), front, from_above), 5);
  EXPECT_GT(density(cache, Vec3::Zero(), back, from_below), 5);
  EXPECT_LT(density(cache, Vec3::Zero(), front, from_below), 1e-3f);
  for (const CacheCell& cell : cache.cells) EXPECT_GT(std::abs(cell.normal.x()), 0.99f);
}

TEST(CacheTrain, GuidesNothingOnTheUnlitSideOfAWall) {
  const GuideCache cache = train(beam(20'000, Vec3(1, 0, 1), Vec3::UnitX()), floor_info(1000));
  EXPECT_NE(GuideCacheView(cache).query(Vec3::Zero(), Vec3::UnitX()), nullptr);
  EXPECT_EQ(GuideCacheView(cache).query(Vec3::Zero(), -Vec3::UnitX()), nullptr);
}

// Half of the floor behind a door is in the scene's bounds, and in the leaf of the last cell.
TEST(CacheTrain, GuidesNothingWhereNoPhotonCame) {
  PhotonStreamInfo info = floor_info(4000);
  info.scene_bounds.extend(Vec3(20 * kFloor, kFloor, 1));
  CacheTrainOptions options;
  options.photons_per_cell = 1'000'000;
  const GuideCache cache = train(floor_photons(4000), info, options);
  ASSERT_EQ(cache.cells.size(), 1u);
  const GuideCacheView view(cache);
  EXPECT_NE(view.query({0.5f * kFloor, 0, 0}, Vec3::UnitZ()), nullptr);
  EXPECT_EQ(view.query({10 * kFloor, 0, 0}, Vec3::UnitZ()), nullptr);
}

// One photon in a hundred strays to the far end of a corridor, which the box of the cell then
// holds.
TEST(CacheTrain, AFewStrayPhotonsDoNotWidenTheReach) {
  std::vector<Photon> photons = floor_photons(4000);
  for (size_t i = 0; i < photons.size(); i += 100) photons[i].position.x() += 10 * kFloor;
  PhotonStreamInfo info = floor_info(4000);
  info.scene_bounds.extend(Vec3(20 * kFloor, kFloor, 1));
  CacheTrainOptions options;
  options.photons_per_cell = 1'000'000;
  const GuideCache cache = train(photons, info, options);
  ASSERT_EQ(cache.cells.size(), 1u);
  const GuideCacheView view(cache);
  EXPECT_NE(view.query({0.5f * kFloor, 0, 0}, Vec3::UnitZ()), nullptr);
  EXPECT_EQ(view.query({8 * kFloor, 0, 0}, Vec3::UnitZ()), nullptr);
}

// The cell is split at the mean height of its photons, which is above all but the two.
TEST(CacheTrain, TwoStrayPhotonsHighUpLeaveEveryCellAReach) {
  std::vector<Photon> photons = floor_photons(100'000);
  for (const size_t i : {1000, 3000}) photons[i].position.z() += 200 * kFloor;
  PhotonStreamInfo info = floor_info(100'000);
  info.scene_bounds.extend(Vec3(0, 0, 300 * kFloor));
  CacheTrainOptions options;
  options.photons_per_cell = 1000;
  const GuideCache cache = train(photons, info, options);
  ASSERT_GT(cache.cells.size(), 1u);
  for (const CellReach& reach : cache.reaches) {
    EXPECT_TRUE(reach.min.allFinite() && reach.max.allFinite());
    EXPECT_TRUE((reach.min.array() < reach.max.array()).all());
  }
}

TEST(CacheTrain, ReachesOfAFinishedTrainingGoOn) {
  const auto photons = floor_photons(8000);
  const GuideCache first = train(std::span(photons).first(4000), floor_info(4000));
  const GuideCache second = train({}, floor_info(4000), {}, nullptr, first);
  ASSERT_EQ(first.reaches.size(), second.reaches.size());
  for (size_t i = 0; i < first.reaches.size(); ++i) {
    EXPECT_LT(first.reaches[i].max.maxCoeff(), 4 * kFloor);
    EXPECT_EQ(second.reaches[i].min, first.reaches[i].min);
    EXPECT_EQ(second.reaches[i].max, first.reaches[i].max);
  }
}

// A split deals those out that wait for their batch to fill.
TEST(CacheTrain, NoPhotonIsLearnedTwice) {
  const auto photons = floor_photons(100'000);
  CacheTrainOptions options;
  options.photons_per_cell = 200;
  const GuideCache cache = train(photons, floor_info(100'000), options);
  EXPECT_GT(cache.cells.size(), 50u);
  double learned = 0;
  for (const CacheCell& cell : cache.cells) learned += cell.photon_count;
  EXPECT_LE(learned, photons.size());
  EXPECT_GT(learned, 0.8 * photons.size());
}

TEST(CacheTrain, LightTooStrongOrTooFaintForItsNumbersStaysFinite) {
  for (const float power : {1e30f, 1e-37f}) {
    const std::vector<Photon> photons(1000, photon_from(Vec3::UnitZ(), power));
    const GuideCache cache = train(photons, floor_info(1));  // which passed check()
    EXPECT_EQ(check_training(cache), "");
    for (const CacheCell& cell : cache.cells) EXPECT_TRUE(std::isfinite(cell.irradiance));
  }
}

TEST(CacheTrain, FramesFollowACurvedSurface) {
  std::vector<Photon> photons;
  for (uint32_t i = 0; i < 200'000; ++i) {
    Sampler sampler(5, 0, i);
    const Vec3 normal = square_to_sphere(sampler.next_2d());
    photons.push_back({normal * 0.5f,
                       Frame(normal).to_world(square_to_cosine_hemisphere(sampler.next_2d())),
                       normal, Color::Ones(), 1});
  }
  CacheTrainSummary summary;
  const GuideCache cache = train(photons, floor_info(1000), {}, &summary);
  int silent = 0;
  for (const Photon& p : std::span(photons).first(2000)) {
    const CacheCell* cell = GuideCacheView(cache).query(p.position, p.normal);
    silent += cell == nullptr;
    if (cell) {
      EXPECT_GT(cell->normal.dot(p.normal), 0.7f);
    }
  }
  EXPECT_LT(silent, 20);
  EXPECT_LT(summary.lost_mass, 0.02);
}

TEST(CacheTrain, OneFireflyDoesNotCaptureTheMixture) {
  for (size_t place : {size_t{5}, size_t{7000}}) {
    std::vector<Photon> photons = beam(10'000, Vec3::UnitZ(), Vec3::UnitZ());
    const float before =
        density(train(photons, floor_info(1)), Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ());
    photons[place] = photon_from(Vec3(1, 0, 0.2f), 1e8f);
    CacheTrainSummary summary;
    const GuideCache cache = train(photons, floor_info(1), {}, &summary);
    EXPECT_EQ(summary.weights_capped, 1u);
    EXPECT_GT(density(cache, Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ()), 0.5f * before);
  }
}

TEST(CacheTrain, PowersOfAnyMagnitudeGiveTheSameLobes) {
  const float normal = density(train(beam(9'000, Vec3::UnitZ(), Vec3::UnitZ()), floor_info(1)),
                               Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ());
  for (float power : {1e-30f, 1e30f}) {
    const GuideCache cache = train(beam(9'000, Vec3::UnitZ(), Vec3::UnitZ(), power), floor_info(1));
    EXPECT_NEAR(density(cache, Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitZ()), normal, 0.01f * normal);
  }
}

TEST(CacheTrain, DropsDirectLightFromTheMixtureButNotFromTheIrradiance) {
  std::vector<Photon> photons;
  const std::vector<Photon> indirect = beam(10'000, Vec3(1, 0, 1), Vec3::UnitZ());
  std::vector<Photon> direct = beam(10'000, Vec3(-1, 0, 1), Vec3::UnitZ());
  for (Photon& p : direct) p.path_depth = 0;
  for (size_t i = 0; i < direct.size(); ++i)
    photons.insert(photons.end(), {indirect[i], direct[i]});
  CacheTrainOptions drop, keep;
  drop.direct = DirectLight::drop;
  keep.direct = DirectLight::keep;
  CacheTrainSummary summary;
  const GuideCache without = train(photons, floor_info(1), drop, &summary);
  const GuideCache with = train(photons, floor_info(1), keep);
  EXPECT_EQ(summary.dropped_direct, 10'000u);
  EXPECT_LT(density(without, Vec3::Zero(), Vec3::UnitZ(), Vec3(-1, 0, 1)), 1e-3f);
  EXPECT_GT(density(with, Vec3::Zero(), Vec3::UnitZ(), Vec3(-1, 0, 1)), 1);
  EXPECT_EQ(without.cells[0].irradiance, with.cells[0].irradiance);
}

TEST(CacheTrain, LobesFollowTheEvidence) {
  const auto components_after = [](int photons) {
    return train(beam(photons, Vec3::UnitZ(), Vec3::UnitZ()), floor_info(1)).components.size();
  };
  EXPECT_EQ(components_after(0), 0u);
  EXPECT_EQ(components_after(15), 0u);
  EXPECT_EQ(components_after(20), 2u);
  EXPECT_GT(components_after(4000), 4u);
}

TEST(CacheTrain, MemoryIsBoundedByCells) {
  CacheTrainOptions options;
  options.max_cells = 5;
  CacheTrainSummary few, many;
  train(floor_photons(60'000), floor_info(60'000), options, &few);
  train(floor_photons(240'000), floor_info(240'000), options, &many);
  EXPECT_EQ(few.cells, 5u);
  EXPECT_EQ(few.bytes, many.bytes);
  EXPECT_LT(few.bytes, 5u * 2048);
}

TEST(CacheTrain, SurvivesPhotonsOnALineFromOneDirection) {
  std::vector<Photon> photons;
  for (int i = 0; i < 30'000; ++i) {
    photons.push_back(photon_from(Vec3(0, 1, 1e-3f)));  // at the rim of the disk
    photons.back().position.x() = Sampler(2, 0, i).next() - 0.5f;
  }
  const GuideCache cache = train(photons, floor_info(1));
  EXPECT_GT(density(cache, Vec3(0.2f, 0, 0), Vec3::UnitZ(), Vec3(0, 1, 1e-3f)), 10);
  for (const CacheCell& cell : cache.cells) EXPECT_TRUE(std::isfinite(cell.irradiance));
}

TEST(CacheTrainOptions, NameTheFieldThatIsWrong) {
  const auto message = [](auto&& change) -> std::string {
    CacheTrainOptions options;
    change(options);
    try {
      options.validate();
    } catch (const Misuse& misuse) {
      return misuse.what();
    }
    return "";
  };
  EXPECT_EQ(message([](CacheTrainOptions&) {}), "");
  EXPECT_NE(message([](auto& o) { o.components = 9; }).find("components"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.photons_per_cell = 1; }).find("photons_per_cell"),
            std::string::npos);
  EXPECT_NE(message([](auto& o) { o.max_cells = 0; }).find("max_cells"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.normal_spread = kNan; }).find("normal_spread"),
            std::string::npos);
  EXPECT_EQ(message([](auto& o) { o.normal_spread = 0; }), "");  // no split by orientation
  EXPECT_NE(message([](auto& o) { o.prior.b = 0; }).find("prior.b"), std::string::npos);
}

}  // namespace
}  // namespace waylight
