// Training of the part of a cache that is of media.

#include <gtest/gtest.h>

#include <functional>

#include "common/fog_photons.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/cache/training_check.h"
#include "libguide/cache_train.h"
#include "libguide/directional/vmf_mixture.h"

namespace waylight {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The medium fills the scene.
const Bounds kBox = {Vec3(-1, 2, 0), Vec3(1, 3, 0.5f)};  // of volume 1

PhotonStreamInfo fog_info(uint64_t emitted, const Bounds& bounds = kBox) {
  return testing::fog_info(emitted, bounds);
}

struct Light {
  float fluence = 1;
  uint32_t path_depth = 1;
  std::function<Vec3(const Vec2&)> direction = square_to_sphere;
};

// `count` photons of a fluence that is the same all over the box.
std::vector<MediumPhoton> even_light(int count, const Light& light, uint64_t seed = 1) {
  std::vector<MediumPhoton> photons;
  for (int i = 0; i < count; ++i) {
    Sampler sampler(seed, 0, i);
    const Vec3 place = testing::place_in(kBox, sampler);
    photons.push_back({place, light.direction(sampler.next_2d()),
                       Color::Constant(light.fluence / count), light.path_depth});
  }
  return photons;
}

Light lobe(const Vec3& mean, float kappa) {
  return {1, 1, [=](const Vec2& u) { return sample_vmf(mean.normalized(), kappa, u); }};
}

// Alternately, so that all parts of the stream have both.
std::vector<MediumPhoton> mixed(const std::vector<MediumPhoton>& a,
                                const std::vector<MediumPhoton>& b) {
  std::vector<MediumPhoton> photons;
  for (size_t i = 0; i < a.size(); ++i) photons.insert(photons.end(), {a[i], b[i]});
  return photons;
}

GuideCache train(std::span<const MediumPhoton> photons, const PhotonStreamInfo& info,
                 const CacheTrainOptions& options = {}, CacheTrainSummary* summary = nullptr,
                 GuideCache previous = {}) {
  CacheTrainer trainer(options, info, std::move(previous));
  trainer.consume(photons);
  GuideCache cache = trainer.finish(summary);
  EXPECT_EQ(check(GuideCacheView(cache)), "");
  EXPECT_EQ(check_training(cache), "");
  return cache;
}

VmfMixture mixture_at(const GuideCache& cache, const Vec3& x,
                      MediumLight MediumCell::*light = &MediumCell::indirect) {
  const MediumCacheView view(cache.medium);
  return VmfMixture(view.lobes(view.query(x)->*light));
}

// The mean of the directions of a mixture.
Vec3 resultant(const VmfMixture& mixture) {
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < mixture.count(); ++k) {
    const VmfComponent c = mixture.component(k);
    sum += c.weight * static_cast<float>(mean_cosine(c.kappa)) * c.mean;
  }
  return sum;
}

struct Spread {
  double mean = 0, deviation = 0;
};

using LightPointer = MediumLight MediumCell::*;

// Of the fluence divided by the truth, over places of the box.
template <typename Truth>
Spread spread_of(const GuideCache& cache, LightPointer light, const Truth& truth) {
  constexpr int kPlaces = 2000;
  const MediumCacheView view(cache.medium);
  double sum = 0, sum2 = 0;
  for (int i = 0; i < kPlaces; ++i) {
    Sampler sampler(9, 0, i);
    const Vec2 u = sampler.next_2d();
    const Vec3 place(u.x(), u.y(), sampler.next());
    const Vec3 x = kBox.min + place.cwiseProduct(kBox.max - kBox.min);
    const double ratio = (view.query(x)->*light).fluence / truth(place);
    sum += ratio / kPlaces, sum2 += ratio * ratio / kPlaces;
  }
  return {sum, std::sqrt(sum2 - sum * sum)};
}

Spread spread_of(const GuideCache& cache, LightPointer light) {
  return spread_of(cache, light, [](const Vec3&) { return 1.0; });
}

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

// All fields of the medium, without the padding between them.
std::string bytes_of(const GuideCache& cache) {
  const MediumCache& m = cache.medium;
  std::string bytes;
  append(bytes, m.photons), append(bytes, m.emitted);
  for (const CacheNode& node : m.nodes) append(bytes, node);
  for (const MediumCell& cell : m.cells) append(bytes, cell);
  for (const VmfComponent& component : m.components) append(bytes, component);
  for (const VmfStatistics& statistics : m.statistics) append(bytes, statistics);
  for (const MediumTraining& t : m.training) {
    for (const Vec3* v : {&t.position_mean, &t.position_m2, &t.position_cross}) append(bytes, *v);
    append(bytes, t.born), append(bytes, t.occupied);
    append(bytes, t.count), append(bytes, t.inherited_volume);
    append(bytes, t.indirect), append(bytes, t.direct);
  }
  return bytes;
}

TEST(CacheTrainMedia, FluenceOfAnEvenlyLitBox) {
  const std::vector<MediumPhoton> photons =
      mixed(even_light(100'000, {3, 1}, 1), even_light(100'000, {0.5f, 0}, 2));
  CacheTrainSummary summary;
  const GuideCache cache = train(photons, fog_info(7000), {}, &summary);
  const Spread indirect = spread_of(cache, &MediumCell::indirect);
  const Spread direct = spread_of(cache, &MediumCell::direct);
  EXPECT_NEAR(indirect.mean, 3, 0.02 * 3);
  EXPECT_NEAR(direct.mean, 0.5, 0.02 * 0.5);
  EXPECT_LT(indirect.deviation, 0.10 * 3);
  EXPECT_LT(direct.deviation, 0.10 * 0.5);
  EXPECT_GT(cache.medium.cells.size(), 50u);
  EXPECT_EQ(summary.media.photons, 200'000u);
  EXPECT_EQ(summary.media.cells, cache.medium.cells.size());
  EXPECT_EQ(summary.media.rejected + summary.photons, 0u);
  EXPECT_EQ(summary.media.indirect.cells_with_mixture, summary.media.cells);
  EXPECT_GT(summary.media.indirect.mean_effective_samples, 500);
}

// Where light falls off exponentially along x, to e^-3 of what it is, fluence and cells follow it.
TEST(CacheTrainMedia, FluenceOfLightThatFallsOff) {
  constexpr float kThickness = 3;
  std::vector<MediumPhoton> photons = even_light(200'000, {1, 1});
  for (MediumPhoton& p : photons) {
    const float u = 0.5f * (p.position.x() + 1);
    p.position.x() = 2 * -std::log1p(u * std::expm1(-kThickness)) / kThickness - 1;
  }
  const GuideCache cache = train(photons, fog_info(1000));
  EXPECT_NEAR(spread_of(cache, &MediumCell::indirect).mean, 1, 0.02) << "all of the light";
  const Spread s = spread_of(cache, &MediumCell::indirect, [](const Vec3& place) {
    return kThickness * std::exp(-kThickness * place.x()) / -std::expm1(-kThickness);
  });
  EXPECT_NEAR(s.mean, 1, 0.05);
  EXPECT_LT(s.deviation, 0.25);  // cells have an extent
}

// All along the surface of a ball cells are cut. With 1000 cells the mean is 1 % low.
TEST(CacheTrainMedia, FluenceInABall) {
  const auto place = [](uint64_t seed, uint32_t i) -> Vec3 {
    Sampler sampler(seed, 0, i);
    const Vec2 u = sampler.next_2d();
    return Vec3(0, 2.5f, 0.25f) + 0.25f * std::cbrt(sampler.next()) * square_to_sphere(u);
  };
  std::vector<MediumPhoton> photons = even_light(200'000, {4 * kPi / 3 / 64, 1});
  for (uint32_t i = 0; i < photons.size(); ++i) photons[i].position = place(1, i);
  const GuideCache cache = train(photons, fog_info(1000));
  const MediumCacheView view(cache.medium);
  double sum = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    const float fluence = view.query(place(2, i))->indirect.fluence;
    EXPECT_NEAR(fluence, 1, 0.35);
    sum += fluence / 2000;
  }
  EXPECT_NEAR(sum, 1, 0.05);
}

TEST(CacheTrainMedia, RecoversTheDirectionAndTheMeanCosineOfOneLobe) {
  const Vec3 mean = Vec3(1, -2, 0.5f).normalized();
  for (const float kappa : {0.5f, 5.0f, 200.0f}) {
    const GuideCache cache = train(even_light(60'000, lobe(mean, kappa)), fog_info(100));
    for (const Vec3& x : {Vec3(-0.9f, 2.1f, 0.1f), Vec3(0, 2.5f, 0.25f), Vec3(0.7f, 2.9f, 0.4f)}) {
      const Vec3 found = resultant(mixture_at(cache, x));
      EXPECT_NEAR(found.norm(), mean_cosine(kappa), 0.03) << kappa;
      EXPECT_GT(found.normalized().dot(mean), kappa < 1 ? 0.95f : 0.998f) << kappa;
    }
  }
}

TEST(CacheTrainMedia, FindsTwoLobes) {
  const Vec3 a(0, 0, 1), b(1, 0, 0);
  const GuideCache cache = train(
      mixed(even_light(30'000, lobe(a, 100), 1), even_light(30'000, lobe(b, 30), 2)), fog_info(1));
  for (const Vec3& x : {Vec3(-0.5f, 2.3f, 0.1f), Vec3(0.5f, 2.7f, 0.4f)}) {
    const VmfMixture mixture = mixture_at(cache, x);
    EXPECT_NEAR(mixture.pdf(a), 0.5f * vmf_norm(100), 0.25f * 0.5f * vmf_norm(100));
    EXPECT_NEAR(mixture.pdf(b), 0.5f * vmf_norm(30), 0.25f * 0.5f * vmf_norm(30));
    EXPECT_LT(mixture.pdf(-a), 0.01f);
  }
}

TEST(CacheTrainMedia, KeepsDirectLightApart) {
  Light direct = lobe(Vec3::UnitX(), 50);
  direct.path_depth = 0;
  const GuideCache cache =
      train(mixed(even_light(20'000, direct, 1), even_light(20'000, lobe(-Vec3::UnitX(), 50), 2)),
            fog_info(1));
  const Vec3 x(0.2f, 2.2f, 0.2f);
  EXPECT_GT(mixture_at(cache, x, &MediumCell::direct).pdf(Vec3::UnitX()), 4);
  EXPECT_LT(mixture_at(cache, x, &MediumCell::direct).pdf(-Vec3::UnitX()), 1e-3f);
  EXPECT_LT(mixture_at(cache, x).pdf(Vec3::UnitX()), 1e-3f);
  EXPECT_GT(mixture_at(cache, x).pdf(-Vec3::UnitX()), 4);
  for (const MediumCell& cell : cache.medium.cells) EXPECT_LE(cell.direct.component_count, 4u);
}

TEST(CacheTrainMedia, ResultDoesNotDependOnHowTheStreamIsCut) {
  const std::vector<MediumPhoton> photons = even_light(60'000, lobe(Vec3::UnitY(), 3));
  const std::string whole = bytes_of(train(photons, fog_info(500)));
  for (const size_t cut : {1, 777, 16384}) {
    CacheTrainer trainer({}, fog_info(500));
    for (size_t begin = 0; begin < photons.size(); begin += cut)
      trainer.consume(std::span(photons).subspan(begin, std::min(cut, photons.size() - begin)));
    EXPECT_EQ(bytes_of(trainer.finish(nullptr)), whole) << "pieces of " << cut;
  }
}

TEST(CacheTrainMedia, ResultDoesNotDependOnThreads) {
  const std::vector<MediumPhoton> photons = even_light(200'000, lobe(Vec3::UnitY(), 3));
  std::string bytes[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    bytes[threads - 1] = bytes_of(train(photons, fog_info(500)));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(CacheTrainMedia, GoingOnIsAsGoodAsTrainingInOneGo) {
  const Light light = lobe(Vec3(1, 1, 1), 20);
  const std::vector<MediumPhoton> first = even_light(80'000, light, 1);
  const std::vector<MediumPhoton> second = even_light(80'000, light, 2);
  std::vector<MediumPhoton> all = first;
  all.insert(all.end(), second.begin(), second.end());
  for (MediumPhoton& p : all) p.weight *= 0.5f;  // one stream of twice as many particles
  const GuideCache whole = train(all, fog_info(2000));
  const GuideCache halves =
      train(second, fog_info(1000), {}, nullptr, train(first, fog_info(1000)));
  EXPECT_EQ(halves.medium.emitted, whole.medium.emitted);
  EXPECT_EQ(halves.medium.photons, whole.medium.photons);
  EXPECT_NEAR(static_cast<double>(halves.medium.cells.size()) / whole.medium.cells.size(), 1, 0.15);
  const Spread a = spread_of(whole, &MediumCell::indirect);
  const Spread b = spread_of(halves, &MediumCell::indirect);
  EXPECT_NEAR(a.mean, b.mean, 0.02);
  EXPECT_NEAR(a.deviation, b.deviation, 0.02);
  for (const Vec3& x : {Vec3(-0.5f, 2.3f, 0.1f), Vec3(0.5f, 2.7f, 0.4f)})
    EXPECT_LT((resultant(mixture_at(whole, x)) - resultant(mixture_at(halves, x))).norm(), 0.03f);
}

// The second stream has ten times the photons per particle, as guided ones would.
TEST(CacheTrainMedia, StreamsOfOtherPhotonsPerParticleAgreeOnTheFluence) {
  GuideCache cache = train(even_light(30'000, {2, 1}, 1), fog_info(20'000));
  cache = train(even_light(300'000, {2, 1}, 2), fog_info(20'000), {}, nullptr, std::move(cache));
  const Spread s = spread_of(cache, &MediumCell::indirect);
  EXPECT_NEAR(s.mean, 2, 0.04);
  EXPECT_LT(s.deviation, 0.3);
}

TEST(CacheTrainMedia, PassesWithoutMediaBeforeOrBetweenCountNoParticles) {
  PhotonStreamInfo no_media = fog_info(5000);
  no_media.media = false;
  GuideCache cache = train({}, no_media);
  EXPECT_TRUE(cache.medium.cells.empty());
  cache = train(even_light(20'000, {2, 1}), fog_info(1000), {}, nullptr, std::move(cache));
  cache = train({}, no_media, {}, nullptr, std::move(cache));
  EXPECT_EQ(cache.medium.emitted, 1000u);
  EXPECT_EQ(cache.emitted, 11'000u);
  EXPECT_NEAR(spread_of(cache, &MediumCell::indirect).mean, 2, 0.06);
}

TEST(CacheTrainMedia, FillsOnlyThePartOfTheSceneThatHoldsMedium) {
  const Bounds room = {Vec3(-10, -10, -10), Vec3(10, 10, 10)};
  const GuideCache cache = train(even_light(200'000, {2, 1}), fog_info(1000, room));
  const MediumCacheView view(cache.medium);
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    Sampler sampler(3, 0, i);
    const Vec2 u = sampler.next_2d();
    sum +=
        view.query(Vec3(2 * u.x() - 1, 2 + u.y(), 0.5f * sampler.next()))->indirect.fluence / 1000;
  }
  EXPECT_NEAR(sum, 2, 0.1);
}

TEST(CacheTrainMedia, CellsThatAreStarvedBorrow) {
  std::vector<MediumPhoton> photons = even_light(40'000, lobe(Vec3::UnitZ(), 50));
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].path_depth = photons[i].position.x() < 0 || i % 500 == 0 ? 1 : 0;
  const GuideCache cache = train(photons, fog_info(10));
  for (const MediumCell& cell : cache.medium.cells) {
    EXPECT_GT(cell.indirect.component_count, 0u);
    EXPECT_GT(cell.direct.component_count, 0u);
  }
}

TEST(CacheTrainMedia, MemoryIsBoundedByCells) {
  CacheTrainOptions options;
  options.max_cells = 5;
  CacheTrainSummary few, many;
  train(even_light(30'000, {}), fog_info(1), options, &few);
  train(even_light(120'000, {}), fog_info(1), options, &many);
  EXPECT_EQ(few.media.cells, 5u);
  EXPECT_EQ(few.media.bytes, many.media.bytes);
  EXPECT_LT(few.media.bytes, 5u * 3500);
}

TEST(CacheTrainMedia, CountsAndRefusesPhotonsThatAreNone) {
  std::vector<MediumPhoton> photons = even_light(3000, lobe(Vec3::UnitX(), 10));
  const GuideCache clean = train(photons, fog_info(10));
  const auto bad = [&](auto&& damage) {
    photons.push_back(photons.front());
    damage(photons.back());
  };
  bad([](MediumPhoton& p) { p.position.x() = kNan; });
  bad([](MediumPhoton& p) { p.position.y() = -2; });
  bad([](MediumPhoton& p) { p.position.z() = kInfinity; });
  bad([](MediumPhoton& p) { p.direction *= 2; });
  bad([](MediumPhoton& p) { p.direction.x() = kNan; });
  bad([](MediumPhoton& p) { p.weight = Color::Zero(); });
  bad([](MediumPhoton& p) { p.weight.x() = kNan; });
  bad([](MediumPhoton& p) { p.weight.y() = kInfinity; });
  bad([](MediumPhoton& p) { p.weight.z() = -1; });
  bad([](MediumPhoton& p) { p.weight = Color::Constant(1e37f); });
  CacheTrainSummary summary;
  const GuideCache cache = train(photons, fog_info(10), {}, &summary);
  EXPECT_EQ(summary.media.photons, 3010u);
  EXPECT_EQ(summary.media.rejected, 10u);
  ASSERT_EQ(cache.medium.components.size(), clean.medium.components.size());
  for (size_t i = 0; i < cache.medium.components.size(); ++i)
    EXPECT_EQ(cache.medium.components[i].kappa, clean.medium.components[i].kappa);
  EXPECT_EQ(cache.medium.training[0].indirect.flux, clean.medium.training[0].indirect.flux);
}

TEST(CacheTrainMedia, PhotonsThatAreAllRefusedMakeACellThatKnowsNothing) {
  const std::vector<MediumPhoton> bad(10, {Vec3::Constant(kNan), Vec3::UnitX(), Color::Ones(), 1});
  const GuideCache cache = train(bad, fog_info(1));
  ASSERT_EQ(cache.medium.cells.size(), 1u);
  EXPECT_EQ(cache.medium.cells[0].indirect.fluence, 0);
  EXPECT_TRUE(MediumCacheView(cache.medium).lobes(cache.medium.cells[0].direct).empty());
}

TEST(CacheTrainMedia, OneFireflyDoesNotCaptureTheMixture) {
  for (const size_t place : {size_t{5}, size_t{7000}}) {
    std::vector<MediumPhoton> photons = even_light(10'000, lobe(Vec3::UnitZ(), 50));
    const Vec3 x = photons[place].position;
    const float before = mixture_at(train(photons, fog_info(1)), x).pdf(Vec3::UnitZ());
    photons[place].direction = Vec3::UnitX();
    photons[place].weight *= 1e8f;
    CacheTrainSummary summary;
    const GuideCache cache = train(photons, fog_info(1), {}, &summary);
    EXPECT_GE(summary.media.weights_capped, 1u);
    EXPECT_GT(mixture_at(cache, x).pdf(Vec3::UnitZ()), 0.5f * before);
  }
}

TEST(CacheTrainMedia, WeightsOfAnyMagnitudeGiveTheSameLobes) {
  const auto peak = [](float scale) {
    std::vector<MediumPhoton> photons = even_light(9000, lobe(Vec3::UnitZ(), 50));
    for (MediumPhoton& p : photons) p.weight *= scale;
    return mixture_at(train(photons, fog_info(1)), Vec3(0.1f, 2.5f, 0.2f)).pdf(Vec3::UnitZ());
  };
  for (const float scale : {1e-30f, 1e30f}) EXPECT_NEAR(peak(scale), peak(1), 0.01f * peak(1));
}

TEST(CacheTrainMedia, SurvivesPhotonsInOnePlaceAndOnALine) {
  std::vector<MediumPhoton> photons(20'000, {Vec3(0, 2.5f, 0.2f), Vec3::UnitX(), Color::Ones(), 1});
  CacheTrainSummary summary;
  const GuideCache point = train(photons, fog_info(1), {}, &summary);
  EXPECT_EQ(summary.media.cells, 1u);
  EXPECT_TRUE(std::isfinite(point.medium.cells[0].indirect.fluence));
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].position.x() = Sampler(2, 0, static_cast<uint32_t>(i)).next() - 0.5f;
  const GuideCache line = train(photons, fog_info(1));
  EXPECT_GT(mixture_at(line, photons[0].position).pdf(Vec3::UnitX()), 100);
}

TEST(CacheTrainMedia, SurfacesAndMediaAreTrainedBesideEachOther) {
  const std::vector<MediumPhoton> photons = even_light(20'000, {});
  std::vector<Photon> of_surfaces;
  for (const MediumPhoton& p : photons)
    of_surfaces.push_back({p.position, Vec3::UnitZ(), Vec3::UnitZ(), p.weight, 1});
  CacheTrainer trainer({}, fog_info(100));
  for (size_t i = 0; i < photons.size(); i += 1000) {
    trainer.consume(std::span(of_surfaces).subspan(i, 1000));
    trainer.consume(std::span(photons).subspan(i, 1000));
  }
  const GuideCache both = trainer.finish(nullptr);
  EXPECT_EQ(bytes_of(both), bytes_of(train(photons, fog_info(100))));
  EXPECT_GT(both.cells.size(), 10u);
  EXPECT_EQ(both.photons, 20'000u);
}

TEST(CacheTrainMedia, RefusesACacheWhosePartOfMediaIsReducedOrDamaged) {
  const GuideCache good = train(even_light(5000, {}), fog_info(10));
  const auto refused = [&](auto&& damage) {
    GuideCache cache = good;
    damage(cache.medium);
    EXPECT_THROW(CacheTrainer({}, fog_info(1), cache), Error);
  };
  EXPECT_NO_THROW(CacheTrainer({}, fog_info(1), good));
  refused([](MediumCache& m) { m.training.clear(), m.statistics.clear(); });
  refused([](MediumCache& m) { m.nodes[0].axis = 4; });
  refused([](MediumCache& m) { m.statistics[0].s1.x() = kNan; });
  refused([](MediumCache& m) { m.training[0].indirect.samples = 0; });
}

TEST(CacheTrainMedia, OptionsNameTheFieldThatIsWrong) {
  CacheTrainOptions options;
  options.medium_photons_per_cell = 63;
  EXPECT_THROW(options.validate(), Misuse);
  options = {};
  options.medium_prior.length = 1;
  EXPECT_THROW(options.validate(), Misuse);
}

}  // namespace
}  // namespace waylight
