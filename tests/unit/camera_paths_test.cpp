// What camera paths carry back is the light, and cells learn the same from it as from photons.

#include <gtest/gtest.h>

#include <numeric>

#include "common/small_media.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/photon_trace.h"

namespace waylight {
namespace {

constexpr float kEmitted = 2, kReflectance = 0.5f;  // of the furnace: radiance 4 everywhere

// The box [-1, 1]^3, seen from its middle; all walls emit and reflect alike. With a ball in it.
SceneDescription furnace(const MaterialModel& wall, const MaterialModel* ball = nullptr) {
  SceneDescription scene;
  const int walls = testing::add_material(scene, "wall", wall);
  const Vec3 corner(-1, -1, -1), x(2, 0, 0), y(0, 2, 0), z(0, 0, 2);
  for (const auto& [at, a, b] : {std::tuple(corner, z, x), std::tuple(Vec3(corner + y), x, z),
                                 std::tuple(corner, y, z), std::tuple(Vec3(corner + x), z, y),
                                 std::tuple(corner, x, y), std::tuple(Vec3(corner + z), y, x)})
    testing::make_light(scene, testing::add_shape(scene, testing::rectangle(at, a, b), walls),
                        Color::Constant(kEmitted));
  if (ball)
    testing::add_shape(scene, Sphere{{0, 0, 0.5f}, 0.3f, Mat3::Identity()},
                       testing::add_material(scene, "ball", *ball));
  testing::look_along_z(scene, {0, 0, -0.5f}, 8, 8);
  return scene;
}

struct Traced {
  std::vector<Photon> records;
  PhotonStreamInfo stream;
};

Traced trace(const Scene& scene, uint64_t count, uint64_t paths, const TraceGuides& guides = {},
             uint32_t pass = 0) {
  PhotonTraceOptions options;
  options.count = count, options.paths = paths, options.pass = pass;
  Traced result;
  result.stream = {scene.bounds(),
                   count,
                   pass,
                   Quantity::radiance,
                   false,
                   paths,
                   expected_records(scene, options, guides)};
  const auto add = [&](std::span<const Photon> photons) {
    result.records.insert(result.records.end(), photons.begin(), photons.end());
  };
  trace_photons(scene, options, add, {}, {}, guides);
  return result;
}

GuideCache train(const Traced& traced, GuideCache previous = {},
                 const CacheTrainOptions& options = {}) {
  CacheTrainer trainer(options, traced.stream, std::move(previous));
  trainer.consume(traced.records);
  GuideCache cache = trainer.finish(nullptr);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  EXPECT_EQ(check_training(cache), "");
  return cache;
}

struct Irradiance {
  double direct = 0, indirect = 0;
};

// Means over the samples' vertices.
template <typename Where>
Irradiance mean_irradiance(std::span<const Photon> samples, const Where& where) {
  Irradiance sum;
  double looks = 0;
  for (const Photon& s : samples) {
    if (!where(s)) continue;
    looks += s.path_depth > 0;
    (s.path_depth > 0 ? sum.indirect : sum.direct) += luminance(s.power);
  }
  return {sum.direct / looks, sum.indirect / looks};
}
constexpr auto kAnywhere = [](const Photon&) { return true; };
constexpr auto kOnWalls = [](const Photon& s) { return s.position.cwiseAbs().maxCoeff() > 0.99f; };

void expect_furnace(const Irradiance& e) {
  const double radiance = kEmitted / (1 - kReflectance);
  EXPECT_NEAR(e.direct, kPi * kEmitted, 0.01 * kPi * kEmitted);
  EXPECT_NEAR(e.indirect, kPi * (radiance - kEmitted), 0.01 * kPi * (radiance - kEmitted));
}

const DiffuseMaterial kGrey{Texture(kReflectance)};

TEST(CameraPaths, IrradianceInAFurnaceIsTheAnalyticOne) {
  const Scene scene(furnace(kGrey));
  expect_furnace(mean_irradiance(trace(scene, 0, 20000).records, kAnywhere));
}

TEST(CameraPaths, MirrorsBringIndirectLight) {
  const MaterialModel mirror = ConductorMaterial{};  // reflects all
  const Scene scene(furnace(kGrey, &mirror));
  const Irradiance e = mean_irradiance(trace(scene, 0, 20000).records, kOnWalls);
  const double radiance = kEmitted / (1 - kReflectance);
  EXPECT_NEAR(e.direct + e.indirect, kPi * radiance, 0.01 * kPi * radiance);
  EXPECT_LT(e.direct, 0.99 * kPi * kEmitted);  // the ball hides some walls
}

// Not even those of another light, which send most paths to one wall.
TEST(CameraPaths, GuidesChangeNoMean) {
  SceneDescription lamp = furnace(kGrey);
  for (size_t i = 1; i < lamp.emitters.size(); ++i)
    std::get<AreaLight>(lamp.emitters[i]).radiance = Texture(0.01f);
  const Scene other(std::move(lamp)), scene(furnace(kGrey));
  CacheTrainOptions direct;
  direct.direct = DirectLight::keep;
  const GuideCache cache = train(trace(other, 50'000, 0), {}, direct);
  expect_furnace(mean_irradiance(
      trace(scene, 0, 40'000, {.radiance = GuideCacheView(cache)}).records, kAnywhere));
}

// Dense and black but for its glow, a medium lights the walls with its own radiance.
TEST(CameraPaths, GlowOfMediaIsIndirectLight) {
  SceneDescription description = furnace(kGrey);
  for (EmitterDescription& emitter : description.emitters)
    std::get<AreaLight>(emitter).radiance = Texture(0.01f);
  description.media.push_back(testing::homogeneous(Color::Constant(20), Color::Zero()));
  description.media.back().emission.radiance = Color::Constant(kEmitted);
  description.sensor.medium = 0;
  description.sensor.to_world(2, 3) = 0.99f;  // at a wall, for a few to get there
  const Scene scene(std::move(description));
  const Irradiance e = mean_irradiance(trace(scene, 0, 20000).records, kAnywhere);
  EXPECT_NEAR(e.indirect, kPi * kEmitted, 0.03 * kPi * kEmitted);
}

// However narrow the lobe that a path follows, cos / p <= 2 pi.
TEST(CameraPaths, NoSampleIsLargeForASmallDensity) {
  RoughConductorMaterial metal;
  metal.alpha_u = metal.alpha_v = Texture(0.005f);
  const Scene scene(furnace(metal));
  float largest = 0;
  for (const Photon& s : trace(scene, 0, 20000).records)
    if (s.path_depth == 0) largest = std::max(largest, luminance(s.power));
  EXPECT_LE(largest, 2 * kPi * kEmitted * 1.001f);
  EXPECT_GT(largest, kPi * kEmitted);
}

// The light is there, whether or not a narrow lobe without tails scatters it.
TEST(CameraPaths, LightFromWhereTheBsdfScattersNothingCounts) {
  RoughConductorMaterial metal;
  metal.alpha_u = metal.alpha_v = Texture(0.02f);
  metal.distribution = MicrofacetDistribution::beckmann;
  const Scene scene(furnace(metal));
  const Irradiance e = mean_irradiance(trace(scene, 0, 20000).records, kAnywhere);
  EXPECT_NEAR(e.direct, kPi * kEmitted, 0.02 * kPi * kEmitted);
}

TEST(CameraPaths, RoughGlassLooksToBothSidesFromEachVertex) {
  RoughDielectricMaterial glass;
  glass.alpha_u = glass.alpha_v = Texture(0.2f);
  const MaterialModel ball = glass;
  const Scene scene(furnace(kGrey, &ball));
  int outside = 0, inside = 0;
  for (const Photon& s : trace(scene, 0, 5000).records) {
    if (kOnWalls(s)) continue;
    EXPECT_GE(s.normal.dot(s.direction), 0);
    if (s.path_depth > 0) ++(s.normal.dot(s.position - Vec3(0, 0, 0.5f)) > 0 ? outside : inside);
  }
  EXPECT_GT(outside, 1000);
  EXPECT_EQ(outside, inside);
}

TEST(CameraPaths, CellsOfAFurnaceHaveItsIrradiance) {
  const Scene scene(furnace(kGrey));
  const double expected = kPi * kEmitted / (1 - kReflectance);
  for (const auto& [count, paths] :
       {std::pair(0, 40000), std::pair(40000, 40000), std::pair(40000, 0)}) {
    const GuideCache cache = train(trace(scene, count, paths));
    double mean = 0, weight = 0;
    for (size_t i = 0; i < cache.cells.size(); ++i) {
      mean += cache.training[i].count * cache.cells[i].irradiance;
      weight += cache.training[i].count;
    }
    EXPECT_NEAR(mean / weight, expected, 0.02 * expected) << count << " photons";
  }
}

// Total variation between the mixtures of two caches over the disk, [0, 1]: mean over places.
double distance(const GuideCache& a, const GuideCache& b, const Scene& scene) {
  constexpr int kSide = 48, kRays = 200;
  double sum = 0;
  int places = 0;
  for (int i = 0; i < kRays; ++i) {
    Sampler sampler(9, 9, i);
    const Vec3 origin(0, 0, -0.9f);
    const auto at = scene.intersect({origin, square_to_sphere(sampler.next_2d())});
    if (!at) continue;
    const Vec3 normal = at->ns.dot(origin - at->p) < 0 ? Vec3(-at->ns) : at->ns;
    const GuideCacheView view_a(a), view_b(b);
    const CacheCell *in_a = view_a.query(at->p, normal), *in_b = view_b.query(at->p, normal);
    if (!in_a || !in_b) continue;
    const GaussianMixture p = view_a.mixture(*in_a), q = view_b.mixture(*in_b);
    for (int k = 0; k < kSide * kSide; ++k) {
      const Vec2 y((k % kSide + 0.5f) / kSide * 2 - 1, (k / kSide + 0.5f) / kSide * 2 - 1);
      if (y.squaredNorm() > 1) continue;
      const Vec3 wi = Frame(normal).to_world(disk_to_direction(y));
      const auto pdf = [&](const GaussianMixture& m, const CacheCell& cell) {
        return m.pdf(direction_to_disk(Frame(cell.normal).to_local(wi)));
      };
      sum += 0.5 * std::abs(pdf(p, *in_a) - pdf(q, *in_b)) * 4 / (kSide * kSide);
    }
    ++places;
  }
  EXPECT_GT(places, kRays / 2);
  return sum / places;
}

class SameLight : public ::testing::Test {
 protected:
  // Cells as coarse as both kinds can tell.
  static GuideCache learn(const Traced& traced, GuideCache previous = {}) {
    CacheTrainOptions options;
    options.photons_per_cell = 4000;
    return train(traced, std::move(previous), options);
  }
  const Scene scene_{testing::gap_box()};
  const GuideCache photons_ = learn(trace(scene_, 200'000, 0));
};

TEST_F(SameLight, CameraPathsTeachWhatPhotonsTeach) {
  const double noise = distance(photons_, learn(trace(scene_, 200'000, 0, {}, 1)), scene_);
  const GuideCache paths = learn(trace(scene_, 0, 200'000, {.radiance = GuideCacheView(photons_)}));
  EXPECT_LT(distance(photons_, paths, scene_), 2 * noise);
}

TEST_F(SameLight, BothInOneCacheTeachItToo) {
  const double noise = distance(photons_, learn(trace(scene_, 200'000, 0, {}, 1)), scene_);
  EXPECT_LT(distance(photons_, learn(trace(scene_, 200'000, 100'000)), scene_), 1.5 * noise);
}

TEST_F(SameLight, TrainingGoesOnFromEitherKindToTheOther) {
  const GuideCache photons = train(trace(scene_, 200'000, 0));
  const Traced paths = trace(scene_, 0, 100'000, {.radiance = GuideCacheView(photons_)});
  const GuideCache after = train(paths, photons);
  EXPECT_EQ(after.paths, 100'000u);
  EXPECT_EQ(after.emitted, 200'000u);
  EXPECT_EQ(after.sources.size(), after.cells.size());
  const GuideCache back = train(trace(scene_, 200'000, 0, {}, 2), train(paths));
  for (const GuideCache& cache : {after, back}) {
    double irradiance = 0, expected = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec2 u = Sampler(3, 3, i).next_2d() * 1.6f - Vec2::Constant(0.8f);
      const Vec3 place(u.x(), 1, 0.5f * u.y() - 0.4f);  // of the ceiling before the wall
      const auto value = [&](const GuideCache& c) {
        const CacheCell* cell = GuideCacheView(c).query(place, -Vec3::UnitY());
        return cell ? cell->irradiance : 0;
      };
      irradiance += value(cache), expected += value(photons);
    }
    EXPECT_NEAR(irradiance, expected, 0.15 * expected);
  }
}

TEST(CameraPaths, TheResultDoesNotDependOnThreads) {
  const Scene scene(testing::gap_box());
  const auto sums = [&](int threads) {
    const ThreadLimit limit(threads);
    const GuideCache cache = train(trace(scene, 20'000, 20'000));
    double sum = 0;
    for (const CacheCell& cell : cache.cells) sum += cell.irradiance + cell.effective_samples;
    for (const GaussianComponent& c : cache.components) sum += c.mean_x * c.weight + c.cov_xy;
    return sum;
  };
  EXPECT_EQ(sums(1), sums(2));
}

TEST(CameraPaths, WhatDoesNotGoTogetherIsRefused) {
  const Scene scene(testing::gap_box());
  PhotonTraceOptions nothing, importance;
  nothing.count = 0;
  EXPECT_THROW(nothing.validate(), Misuse);
  importance.quantity = Quantity::importance;
  importance.paths = 100;
  EXPECT_THROW(importance.validate(), Misuse);
  const GuideCache cache = train(trace(scene, 20'000, 0));
  EXPECT_THROW(trace(scene, 1000, 0, {.radiance = GuideCacheView(cache)}), Misuse);
}

}  // namespace
}  // namespace waylight
