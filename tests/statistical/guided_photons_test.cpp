// Photons guided by importance carry the flux of those that are not, and are more where it matters.

#include <gtest/gtest.h>

#include "common/small_scenes.h"
#include "libguide/base/parallel.h"
#include "libguide/cache_train.h"
#include "libguide/guiding/emission_guide.h"
#include "libguide/photon_trace.h"

namespace waylight {
namespace {

GuideCache importance_of(const Scene& scene, uint64_t count) {
  PhotonTraceOptions options;
  options.quantity = Quantity::importance;
  options.count = count;
  CacheTrainer trainer({}, {scene.bounds(), count, 0, Quantity::importance});
  trace_photons(
      scene, options, [&](std::span<const Photon> photons) { trainer.consume(photons); }, {},
      [&](std::span<const Escape> escapes) { trainer.consume(escapes); });
  return trainer.finish(nullptr);
}

// Flux per box of a grid over the scene and side of the main axis of the normal, of some batches.
class Flux {
 public:
  static constexpr int kSide = 3, kBoxes = kSide * kSide * kSide * 6, kBatches = 24;

  Flux(const Scene& scene, const GuideCacheView& importance, uint64_t count) {
    for (int batch = 0; batch < kBatches; ++batch) {
      std::vector<double> flux(kBoxes);
      PhotonTraceOptions options;
      options.count = count;
      options.pass = static_cast<uint32_t>(batch);
      options.seed = importance.cells.empty() ? 1 : 2;
      const auto add = [&](std::span<const Photon> photons) {
        for (const Photon& p : photons) flux[box(scene.bounds(), p)] += luminance(p.power);
        stored_ += photons.size();
      };
      trace_photons(scene, options, add, {}, {}, {importance});
      for (int i = 0; i < kBoxes; ++i) sum_[i] += flux[i], sum2_[i] += flux[i] * flux[i];
    }
  }

  double mean(int i) const { return sum_[i] / kBatches; }
  double variance(int i) const {  // of the mean
    return std::max(0.0, sum2_[i] / kBatches - mean(i) * mean(i)) / (kBatches - 1);
  }
  uint64_t stored() const { return stored_; }

 private:
  static int box(const Bounds& bounds, const Photon& p) {
    const Vec3 unit = (p.position - bounds.min).cwiseQuotient(bounds.max - bounds.min);
    int index = 0, axis = 0;
    for (int d = 0; d < 3; ++d)
      index = index * kSide + std::clamp(static_cast<int>(unit[d] * kSide), 0, kSide - 1);
    p.normal.cwiseAbs().maxCoeff(&axis);
    return index * 6 + 2 * axis + (p.normal[axis] > 0);
  }

  std::vector<double> sum_ = std::vector<double>(kBoxes), sum2_ = std::vector<double>(kBoxes);
  uint64_t stored_ = 0;
};

void expect_equal_flux(const Flux& plain, const Flux& guided) {
  int boxes = 0, beyond = 0;
  double sum = 0;
  for (int i = 0; i < Flux::kBoxes; ++i) {
    const double variance = plain.variance(i) + guided.variance(i);
    if (!(plain.mean(i) > 0) || std::sqrt(variance) > 0.25 * plain.mean(i)) continue;
    const double z = (guided.mean(i) - plain.mean(i)) / std::sqrt(variance);
    ++boxes;
    sum += z;
    beyond += std::abs(z) > 3;
    EXPECT_LT(std::abs(z), 5) << "box " << i << ": " << plain.mean(i) << ", " << guided.mean(i);
  }
  EXPECT_GT(boxes, 30);
  EXPECT_LE(beyond, 1 + boxes / 40);
  EXPECT_LT(std::abs(sum), 3.5 * boxes / std::sqrt(8.0)) << "few boxes are independent";
}

class SlowGuidedPhotons : public ::testing::Test {
 protected:
  static void expect_unbiased(const SceneDescription& description) {
    const Scene scene(description);
    const GuideCache cache = importance_of(scene, 100'000);
    const Flux plain(scene, {}, 40000), guided(scene, GuideCacheView(cache), 20000);
    expect_equal_flux(plain, guided);
  }
};

TEST_F(SlowGuidedPhotons, CarryTheSameFluxThroughAGap) { expect_unbiased(testing::gap_box()); }

TEST_F(SlowGuidedPhotons, CarryTheSameFluxThroughAWindow) {
  expect_unbiased(testing::window_box());
}

TEST_F(SlowGuidedPhotons, CarryTheSameFluxOfLampsThatImportonsCannotMeet) {
  SceneDescription scene = testing::window_box();
  scene.emitters.push_back(PointLight{Vec3(0.5f, 0.5f, 0), Color(1, 2, 3)});
  scene.emitters.push_back(DirectionalLight{Vec3(-1, -0.5f, 0).normalized(), Color(3, 3, 3)});
  expect_unbiased(scene);
}

TEST_F(SlowGuidedPhotons, AreManyMoreWhereTheyEnterThroughAWindow) {
  const Scene scene(testing::window_box());
  const GuideCache cache = importance_of(scene, 50'000);
  const auto inside = [&](const GuideCacheView& importance) {
    PhotonTraceOptions options;
    options.count = 20000;
    uint64_t sum = 0;
    trace_photons(
        scene, options,
        [&](std::span<const Photon> photons) {
          for (const Photon& p : photons) sum += p.normal.dot(p.position) < 0;
        },
        {}, {}, {importance});
    return sum;
  };
  EXPECT_GT(inside(GuideCacheView(cache)), 4 * inside({}));
}

// What leaves the emitters, by direction and place, is what plain emission sends.
void expect_equal_emission(const Scene& scene, const GuideCache& cache) {
  const EmissionGuide guide(scene, GuideCacheView(cache));
  constexpr int kCount = 1 << 17;
  Eigen::Array<double, 6, 1> plain_sum = plain_sum.Zero(), plain_sum2 = plain_sum,
                             guided_sum = plain_sum, guided_sum2 = plain_sum;
  const auto moments = [&](const std::optional<EmissionSample>& e) {
    Eigen::Array<double, 6, 1> m = m.Zero();
    if (!e) return m;
    const Vec3 p = e->ray.origin, d = e->ray.direction;
    m << 1, p.x(), p.z(), d.x(), d.y(), d.z();
    return Eigen::Array<double, 6, 1>(m * luminance(e->power));
  };
  for (int i = 0; i < kCount; ++i) {
    Sampler a(3, 0, i), b(3, 1, i);
    const float u = a.next();
    const Vec2 u_position = a.next_2d();
    const Eigen::Array<double, 6, 1> plain =
        moments(scene.sample_emission(u, u_position, a.next_2d()));
    const Eigen::Array<double, 6, 1> guided = moments(guide.sample(b));
    plain_sum += plain, plain_sum2 += plain.square();
    guided_sum += guided, guided_sum2 += guided.square();
  }
  const double n = kCount;
  for (int m = 0; m < 6; ++m) {
    const double variance = (plain_sum2[m] - plain_sum[m] * plain_sum[m] / n) / (n * n) +
                            (guided_sum2[m] - guided_sum[m] * guided_sum[m] / n) / (n * n);
    const double difference = (guided_sum[m] - plain_sum[m]) / n;
    EXPECT_LE(std::abs(difference),
              4 * std::sqrt(std::max(variance, 0.0)) + 1e-3 * plain_sum[0] / n)
        << "moment " << m << ": " << plain_sum[m] / n << ", " << guided_sum[m] / n;
  }
  EXPECT_NEAR(guide.emitted_power(), plain_sum[0] / n, 0.05 * plain_sum[0] / n);
}

TEST(EmissionGuide, SendsWhatAnAreaLightSends) {
  const Scene scene(testing::gap_box());
  expect_equal_emission(scene, importance_of(scene, 30'000));
}

TEST(EmissionGuide, SendsWhatSunAndSkySend) {
  const Scene scene(testing::window_box());
  expect_equal_emission(scene, importance_of(scene, 30'000));
}

TEST(EmissionGuide, SendsWhatAnEnvironmentMapSends) {
  SceneDescription description = testing::window_box();
  auto bitmap = std::make_shared<Bitmap>();
  bitmap->width = 8, bitmap->height = 4;
  for (int i = 0; i < 32; ++i) bitmap->pixels.push_back(Color::Constant(float(i % 5 == 0) + 0.1f));
  EnvironmentMap map;
  map.bitmap = bitmap;
  description.emitters = {map};
  const Scene scene(description);
  expect_equal_emission(scene, importance_of(scene, 30'000));
}

TEST(EmissionGuide, WithoutKnowledgeIsPlainEmission) {
  const Scene scene(testing::gap_box());
  GuideCache nothing;
  nothing.quantity = Quantity::importance;
  expect_equal_emission(scene, nothing);
  EXPECT_EQ(EmissionGuide(scene, GuideCacheView(nothing)).expected_image(), 0);
}

// The guide's own estimate of the image, directly seen light left out.
TEST(EmissionGuide, ExpectsTheImageThatImportonsMeet) {
  const Scene scene(testing::window_box());
  const GuideCache cache = importance_of(scene, 100'000);
  PhotonTraceOptions options;
  options.quantity = Quantity::importance;
  options.count = 100'000;
  options.pass = 1;
  double sum = 0;
  trace_photons(
      scene, options, [](auto) {}, {},
      [&](std::span<const Escape> escapes) {
        for (const Escape& e : escapes)
          if (e.path_depth > 0) sum += luminance(e.power * scene.environment(e.direction));
      });
  EXPECT_NEAR(EmissionGuide(scene, GuideCacheView(cache)).expected_image(), sum, 0.3 * sum);
}

TEST(GuidedPhotons, AreTheSameAtAnyNumberOfThreads) {
  const Scene scene(testing::gap_box());
  const GuideCache cache = importance_of(scene, 20'000);
  const auto positions = [&](int threads) {
    const ThreadLimit limit(threads);
    PhotonTraceOptions options;
    options.count = 4000;
    std::vector<float> all;
    trace_photons(
        scene, options,
        [&](std::span<const Photon> photons) {
          for (const Photon& p : photons) all.push_back(p.position.sum() + p.power.sum());
        },
        {}, {}, {GuideCacheView(cache)});
    return all;
  };
  EXPECT_EQ(positions(1), positions(2));
}

}  // namespace
}  // namespace waylight
