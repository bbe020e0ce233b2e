// F12 of the failure catalogue: guided roulette and splitting under estimates that are wrong.

#include <gtest/gtest.h>

#include "common/image_mean.h"
#include "common/small_scenes.h"
#include "common/trained.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/scene/camera.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {
namespace {

using testing::Trained;

class SlowSplitting : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    SceneDescription description = testing::gap_box(12, 8);
    description.integrator.max_depth = -1;
    scene = new Scene(std::move(description));
    trained = new Trained(testing::train(*scene, 100'000));
    RenderOptions options;
    options.spp = 4096;
    options.seed = 77;
    options.aovs.variance = true;
    reference = new Image(render(*scene, {}, options, nullptr, {}));
  }
  static void TearDownTestSuite() {
    delete reference;
    delete trained;
    delete scene;
  }

  // Few samples where wrong estimates make sixty copies of each path.
  static RenderOptions split_options(int spp) {
    RenderOptions options;
    options.mode = RenderMode::product;
    options.split = kMaxSplit;
    options.spp = spp;
    options.seed = 5;
    options.aovs.variance = true;
    return options;
  }
  static RenderSummary expect_mean_of_path_tracing(const Trained& caches,
                                                   const RenderOptions& options) {
    RenderSummary summary;
    const Image image = render(*scene, caches.caches(), options, &summary, {});
    EXPECT_LT(std::abs(testing::mean_z(image, *reference)), 3.5);
    const testing::Mean mean = testing::mean_of(image);
    EXPECT_LT((mean.sigma / mean.value).maxCoeff(), 0.05f) << "says too little";
    EXPECT_EQ(summary.invalid_samples, 0u);
    return summary;
  }
  // Walks the camera paths of every pixel with the pixel estimate I.
  static std::vector<PathRecord> trace_all(float pixel_estimate, int spp) {
    const SensorDescription& sensor = scene->description().sensor;
    const Camera camera(sensor);
    GuidingCaches caches(testing::lend(trained->brdf), GuideCacheView(trained->guide),
                         scene->description().materials);
    caches.load_fits();
    PathTracerOptions options;
    options.directions.guide = DirectionGuide::product;
    options.roulette = Roulette::guided;
    options.max_split = kMaxSplit;
    const PathTracer tracer(*scene, caches, options);
    std::vector<PathRecord> records;
    for (int y = 0; y < sensor.film.height; ++y)
      for (int x = 0; x < sensor.film.width; ++x)
        for (int s = 0; s < spp; ++s) {
          Sampler sampler(1, uint64_t(y) * sensor.film.width + x, s);
          const Vec2 pixel = Vec2(x, y) + sampler.next_2d();
          const Ray ray = camera.ray(pixel, sampler.next_2d());
          records.push_back(tracer.trace(ray, sampler, {pixel_estimate, 1, nullptr}));
        }
    return records;
  }

  static Scene* scene;
  static Trained* trained;
  static Image* reference;
};
Scene* SlowSplitting::scene = nullptr;
Trained* SlowSplitting::trained = nullptr;
Image* SlowSplitting::reference = nullptr;

TEST_F(SlowSplitting, HasTheMeanOfPathTracingWithBothPixelEstimates) {
  for (const PixelEstimateMode mode : {PixelEstimateMode::cache, PixelEstimateMode::preview}) {
    RenderOptions options = split_options(512);
    options.pixel_estimate = mode;
    const RenderSummary summary = expect_mean_of_path_tracing(*trained, options);
    EXPECT_GT(summary.killed_share, 0.1);
    EXPECT_GT(summary.copies_per_path, 0.05);
  }
}

TEST_F(SlowSplitting, CachesAHundredTimesOffEitherWayOrZeroDoNotBias) {
  Trained wrong = *trained;
  constexpr std::array<float, 4> kFactors = {100, 0.01f, 0, 1};
  for (size_t i = 0; i < wrong.guide.cells.size(); ++i)
    wrong.guide.cells[i].irradiance *= kFactors[i % kFactors.size()];
  for (const PixelEstimateMode mode : {PixelEstimateMode::cache, PixelEstimateMode::preview}) {
    RenderOptions options = split_options(256);  // 64 do not know their variance
    options.pixel_estimate = mode;
    const RenderSummary summary = expect_mean_of_path_tracing(wrong, options);
    EXPECT_GT(summary.killed_share, 0.1);
    EXPECT_GT(summary.copies_per_path, 0.05);
  }
}

TEST_F(SlowSplitting, APixelEstimateThatIsFarOffDoesNotBias) {
  double expected = 0, pixels = 0;
  for (int y = 0; y < reference->height; ++y)
    for (int x = 0; x < reference->width; ++x, ++pixels) expected += reference->at(x, y, 1);
  expected /= pixels;
  for (const float factor :
       {0.0f, 0.01f, 0.1f, 10.0f, 100.0f, std::numeric_limits<float>::quiet_NaN(), kInfinity}) {
    const int spp = factor > 1 && factor < kInfinity ? 512 : 32;  // most paths end early there
    double sum = 0, sum2 = 0, count = 0;
    for (const PathRecord& path : trace_all(factor * float(expected), spp)) {
      sum += path.radiance.y();
      sum2 += sqr(double(path.radiance.y()));
      ++count;
    }
    const double mean = sum / count, deviation = std::sqrt((sum2 / count - mean * mean) / count);
    EXPECT_LT(std::abs(mean - expected), 3.5 * deviation + 0.01 * expected) << factor;
    EXPECT_LT(deviation, 0.05 * expected) << factor << ": says too little";
  }
}

TEST_F(SlowSplitting, ThePopulationOfOneSampleIsBounded) {
  uint32_t most_copies = 0, most_edges = 0;
  for (const PathRecord& path : trace_all(1e-12f, 16)) {
    most_copies = std::max(most_copies, path.copies);
    most_edges = std::max(most_edges, path.edges);
  }
  EXPECT_LE(most_copies, static_cast<uint32_t>(kMaxCopies));
  EXPECT_GT(most_copies, static_cast<uint32_t>(kMaxCopies / 2));  // the bound was what stopped it
  EXPECT_LT(most_edges, 40u * kMaxCopies);
}

TEST_F(SlowSplitting, APixelEstimateFarTooHighEndsPathsButNotAll) {
  uint64_t edges = 0, killed = 0, count = 0;
  for (const PathRecord& path : trace_all(1e12f, 16)) {
    edges += path.edges;
    killed += path.killed;
    ++count;
  }
  EXPECT_GT(killed, count / 2);
  EXPECT_GT(edges, count + count / 20);  // survival is floored at 0.1
}

TEST_F(SlowSplitting, PixelsAreTheSameAtAnyThreadCount) {
  RenderOptions options = split_options(8);
  options.pixel_estimate = PixelEstimateMode::preview;
  options.segments = true;
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    RenderSummary summary;
    const Image image = render(*scene, trained->caches(), options, &summary, {});
    return std::pair(image.pixels, summary.segments.luminance);
  };
  EXPECT_EQ(with_threads(1), with_threads(2));
}

TEST_F(SlowSplitting, AWindowShowsThePixelsOfTheWhole) {
  RenderOptions options = split_options(4);
  options.pixel_estimate = PixelEstimateMode::preview;
  options.width = 96;
  options.height = 64;
  const Image whole = render(*scene, trained->caches(), options, nullptr, {});
  options.crop_x = 40;
  options.crop_y = 30;
  options.crop_width = 9;
  options.crop_height = 7;
  const Image window = render(*scene, trained->caches(), options, nullptr, {});
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      EXPECT_EQ(window.at(x, y, 1), whole.at(x + 40, y + 30, 1));
}

TEST_F(SlowSplitting, ContributionsOfSegmentsAddUpToTheImage) {
  RenderOptions options = split_options(64);
  options.segments = true;
  RenderSummary summary;
  const Image image = render(*scene, trained->caches(), options, &summary, {});
  double of_image = 0, of_segments = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      of_image += luminance({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
  for (const double value : summary.segments.luminance) of_segments += value / options.spp;
  EXPECT_NEAR(of_segments, of_image, 1e-4 * of_image);
  EXPECT_EQ(summary.segments.reached[0], summary.segments.samples);
}

TEST(SplitOptions, AreRefusedWithoutGuidedRouletteAndOutOfRange) {
  RenderOptions options;
  options.spp = 1;
  options.split = 4;
  EXPECT_THROW(options.validate(), Misuse);
  options.mode = RenderMode::product;
  EXPECT_NO_THROW(options.validate());
  options.split = kMaxSplit + 1;
  EXPECT_THROW(options.validate(), Misuse);
}

}  // namespace
}  // namespace waylight
