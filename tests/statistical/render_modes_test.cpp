// Every mode of the renderer has the mean of path tracing, whatever the caches say.

#include <gtest/gtest.h>

#include "common/small_scenes.h"
#include "common/trained.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/render.h"

namespace waylight {
namespace {

using testing::mean_z;
using testing::train;
using testing::Trained;

Image render_mode(const Scene& scene, const Trained& trained, RenderMode mode, int spp,
                  uint64_t seed, RenderSummary* summary = nullptr,
                  RouletteMode roulette = RouletteMode::automatic) {
  RenderOptions options;
  options.roulette = roulette;
  options.mode = mode;
  options.spp = spp;
  options.seed = seed;
  options.aovs.variance = true;
  return render(scene, trained.caches(), options, summary, {});
}

// Share of pixels whose z-score is beyond three.
double share_beyond_three(const Image& a, const Image& b) {
  int beyond = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const double variance = a.at(x, y, 4) + b.at(x, y, 4);
      beyond += std::abs(a.at(x, y, 1) - b.at(x, y, 1)) > 3 * std::sqrt(variance) + 1e-6;
    }
  return double(beyond) / (a.width * a.height);
}

class SlowRenderModes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene = new Scene(testing::gap_box());
    trained = new Trained(train(*scene, 200'000));
    reference = new Image(render_mode(*scene, *trained, RenderMode::bsdf, 4096, 77));
  }
  static void TearDownTestSuite() {
    delete reference;
    delete trained;
    delete scene;
  }
  static Scene* scene;
  static Trained* trained;
  static Image* reference;
};
Scene* SlowRenderModes::scene = nullptr;
Trained* SlowRenderModes::trained = nullptr;
Image* SlowRenderModes::reference = nullptr;

TEST_F(SlowRenderModes, IlluminationGuidingHasTheMeanOfPathTracing) {
  const Image image = render_mode(*scene, *trained, RenderMode::illumination, 1024, 5);
  EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5);
  EXPECT_LT(share_beyond_three(image, *reference), 0.02);
}

TEST_F(SlowRenderModes, TheMixtureOfFitAndLightHasTheMeanOfPathTracing) {
  const Image image = render_mode(*scene, *trained, RenderMode::mixture, 1024, 5);
  EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5);
  EXPECT_LT(share_beyond_three(image, *reference), 0.02);
}

TEST_F(SlowRenderModes, ProductGuidingHasTheMeanOfPathTracing) {
  const Image image = render_mode(*scene, *trained, RenderMode::product, 1024, 5);
  EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5);
  EXPECT_LT(share_beyond_three(image, *reference), 0.02);
}

TEST_F(SlowRenderModes, CellsMergedByTheirLightHaveTheMeanOfPathTracing) {
  const Trained merged = train(*scene, 200'000, true);
  EXPECT_LT(merged.guide.cells.size(), trained->guide.cells.size());
  const Image image = render_mode(*scene, merged, RenderMode::illumination, 1024, 5);
  EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5);
  EXPECT_LT(share_beyond_three(image, *reference), 0.02);
}

TEST_F(SlowRenderModes, ModeAutoHasTheMeanOfPathTracing) {
  RenderSummary summary;
  const Image image = render_mode(*scene, *trained, RenderMode::automatic, 1024, 5, &summary);
  EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5);
  EXPECT_LT(share_beyond_three(image, *reference), 0.02);
  EXPECT_GT(summary.guiding_share, 0.5) << summary.decision.method;  // it pays behind a gap
}

// The render is too small for more than a glance: with 16 samples the pilot cannot compare.
TEST_F(SlowRenderModes, ModeAutoGuidesNothingWhereHardlyAScatteringHasAGuide) {
  Trained starved = *trained;
  for (size_t i = 0; i < starved.guide.cells.size(); ++i)
    if (i % 32 != 0) starved.guide.cells[i].effective_samples = 0;
  RenderSummary few, all;
  render_mode(*scene, starved, RenderMode::automatic, 16, 5, &few);
  render_mode(*scene, *trained, RenderMode::automatic, 16, 5, &all);
  EXPECT_EQ(few.decision.method, "bsdf");
  EXPECT_EQ(few.guiding_share, 0);
  EXPECT_EQ(all.decision.method, "guided");
}

TEST_F(SlowRenderModes, ModeAutoGuidesNothingAtAGlanceByFewCells) {
  const Trained coarse = train(*scene, 2'000);
  ASSERT_LT(coarse.guide.cells.size(), 30u);
  RenderSummary glance;
  render_mode(*scene, coarse, RenderMode::automatic, 16, 5, &glance);
  EXPECT_TRUE(glance.decision.compared.empty());
  EXPECT_EQ(glance.decision.method, "bsdf");
}

TEST_F(SlowRenderModes, ModeAutoAsksForFitsOnceAndOnlyWhereItMayUseThem) {
  const Trained coarse = train(*scene, 2'000);
  RenderOptions options;
  options.mode = RenderMode::automatic;
  options.spp = 16;
  const auto calls_with = [&](const GuideCacheView& guide, const std::string& outcome) {
    int calls = 0;
    RenderSummary summary;
    render(*scene, {testing::lend(trained->brdf, &calls), guide}, options, &summary, {});
    EXPECT_EQ(summary.decision.fits, outcome);
    return calls;
  };
  EXPECT_EQ(calls_with(GuideCacheView(trained->guide), "loaded"), 1);
  EXPECT_EQ(calls_with(GuideCacheView(coarse.guide), "not loaded: few cells"), 0);
  EXPECT_EQ(calls_with({}, "not loaded: no surface has cells"), 0);
}

// A room under a ceiling that shines.
SceneDescription bright_box() {
  SceneDescription scene;
  const int white = testing::add_two_sided(scene, "white", DiffuseMaterial{Texture(0.3f)});
  testing::add_shape(scene, testing::rectangle({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}), white);
  testing::add_shape(scene, testing::rectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), white);
  testing::add_shape(scene, testing::rectangle({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}), white);
  testing::add_shape(scene, testing::rectangle({1, -1, -1}, {0, 0, 2}, {0, 2, 0}), white);
  testing::make_light(
      scene,
      testing::add_shape(scene, testing::rectangle({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), white),
      Color(1, 1, 1));
  testing::look_along_z(scene, {0, 0, -3}, 24, 16);
  return scene;
}

TEST(SlowAutoModes, NothingIsGuidedWherePathTracingHasLittleNoise) {
  const Scene scene(bright_box());
  const Trained trained = train(scene, 200'000);
  RenderSummary summary;
  render_mode(scene, trained, RenderMode::automatic, 3000, 5, &summary);
  ASSERT_GT(summary.decision.compared.size(), 1u);
  const MethodFigures &guided = summary.decision.compared[0], &plain = summary.decision.compared[1];
  EXPECT_LT(plain.variance, 0.3);
  EXPECT_LT(plain.inefficiency(), 4 * guided.inefficiency());
  EXPECT_EQ(summary.decision.method, "bsdf");
  EXPECT_EQ(summary.guiding_share, 0);
}

TEST(SlowAutoModes, ARenderTooSmallToCompareGuidesNothingWhereAFewPathsHaveLittleNoise) {
  const Scene scene(bright_box());
  const Trained trained = train(scene, 200'000);
  ASSERT_GE(trained.guide.cells.size(), 30u);
  RenderSummary summary, smaller;
  render_mode(scene, trained, RenderMode::automatic, 200, 5, &summary);
  EXPECT_TRUE(summary.decision.compared.empty());
  EXPECT_EQ(summary.decision.method, "bsdf");
  EXPECT_EQ(summary.decision.fits, "not loaded: little noise");
  EXPECT_EQ(summary.guiding_share, 0);
  render_mode(scene, trained, RenderMode::automatic, 8, 5, &smaller);
  EXPECT_EQ(smaller.decision.method, "guided");  // too small for these paths too
}

TEST_F(SlowRenderModes, ResamplingHasTheMeanOfPathTracingWithFewCandidatesAndMany) {
  for (const int candidates : {1, 2, 5}) {
    RenderOptions options;
    options.mode = RenderMode::ris;
    options.candidates = candidates;
    options.spp = 1024;
    options.seed = 5;
    options.aovs.variance = true;
    RenderSummary summary;
    const Image image = render(*scene, trained->caches(), options, &summary, {});
    EXPECT_EQ(summary.invalid_samples, 0u);
    EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5) << candidates;
    EXPECT_LT(share_beyond_three(image, *reference), 0.02) << candidates;
  }
}

// share 0: learned.
RenderSummary summary_of(const Scene& scene, const Trained& trained, RenderMode mode, float share) {
  RenderOptions options;
  options.mode = mode;
  options.spp = 256;
  options.seed = 5;
  options.share_rule = share > 0 ? ShareRule::fixed : ShareRule::learned;
  if (share > 0) options.bsdf_share = share;
  RenderSummary summary;
  render(scene, trained.caches(), options, &summary, {});
  return summary;
}

TEST_F(SlowRenderModes, LearnedSharesAreNoWorseThanTheDefault) {
  for (const auto& [mode, share] :
       {std::pair(RenderMode::illumination, 0.5f), std::pair(RenderMode::product, 0.3f)}) {
    const RenderSummary fixed = summary_of(*scene, *trained, mode, share);
    const RenderSummary learned = summary_of(*scene, *trained, mode, 0);
    EXPECT_NEAR(fixed.bsdf_share, share, 0.01);
    EXPECT_NE(learned.bsdf_share, fixed.bsdf_share);
    EXPECT_LT(learned.estimated_relmse, 1.05 * fixed.estimated_relmse);
  }
}

// Every cell looks at one narrow spot, which is dark for all but a few.
TEST_F(SlowRenderModes, CellsThatMisleadAreLeftToBsdfSampling) {
  Trained wrong = *trained;
  for (GaussianComponent& c : wrong.guide.components) c = {c.weight, 0.3f, 0.3f, 2e-4f, 0, 2e-4f};
  const RenderSummary fixed = summary_of(*scene, wrong, RenderMode::product, 0.3f);
  const RenderSummary learned = summary_of(*scene, wrong, RenderMode::product, 0);
  EXPECT_GT(learned.bsdf_share, 0.6);
  EXPECT_LT(learned.estimated_relmse, 0.7 * fixed.estimated_relmse);
}

// Without roulette: from the fifth edge on it kills four paths of five, and its own variance, which
// no choice of directions changes, is then about two thirds of all.
TEST_F(SlowRenderModes, GuidingLowersTheErrorOfLightThroughAGap) {
  const RouletteMode no_roulette = RouletteMode::none;
  RenderSummary bsdf, illumination, product;
  render_mode(*scene, *trained, RenderMode::bsdf, 256, 5, &bsdf, no_roulette);
  render_mode(*scene, *trained, RenderMode::illumination, 256, 5, &illumination, no_roulette);
  render_mode(*scene, *trained, RenderMode::product, 256, 5, &product, no_roulette);
  EXPECT_LT(illumination.estimated_relmse, 0.5 * bsdf.estimated_relmse);
  EXPECT_LT(product.estimated_relmse, 0.4 * bsdf.estimated_relmse);
  EXPECT_GT(product.guiding_share, 0.8);
}

TEST_F(SlowRenderModes, GuidedRouletteEndsPathsAndSavesMoreThanItCosts) {
  RenderSummary guided, none, throughput;
  render_mode(*scene, *trained, RenderMode::product, 256, 5, &guided, RouletteMode::guided);
  render_mode(*scene, *trained, RenderMode::product, 256, 5, &none, RouletteMode::none);
  render_mode(*scene, *trained, RenderMode::product, 256, 5, &throughput, RouletteMode::throughput);
  EXPECT_LT(guided.mean_path_length, 0.9 * none.mean_path_length);
  const auto cost = [](const RenderSummary& s) { return s.estimated_relmse * s.mean_path_length; };
  EXPECT_LT(cost(guided), cost(none));
  EXPECT_LT(cost(guided), cost(throughput));
}

TEST_F(SlowRenderModes, ACacheOfNonsenseDoesNotBias) {
  Trained wrong = *trained;
  std::reverse(wrong.guide.cells.begin(), wrong.guide.cells.end());
  const Image image = render_mode(*scene, wrong, RenderMode::product, 2048, 5);
  EXPECT_LT(std::abs(mean_z(image, *reference)), 3.5);
}

TEST_F(SlowRenderModes, PixelsAreTheSameAtAnyThreadCount) {
  for (const RenderMode mode : {RenderMode::bsdf, RenderMode::illumination, RenderMode::mixture,
                                RenderMode::product, RenderMode::ris}) {
    const auto with_threads = [&](int threads) {
      const ThreadLimit limit(threads);
      return render_mode(*scene, *trained, mode, 32, 3).pixels;  // enough for a pilot
    };
    EXPECT_EQ(with_threads(1), with_threads(2));
  }
}

// The room behind the gap with an anisotropic floor.
SceneDescription gap_box_over(const MaterialModel& floor) {
  SceneDescription scene = testing::gap_box();
  for (Material& material : scene.materials)
    if (material.name == "floor.nested") material.model = floor;
  return scene;
}

void expect_anisotropy_is_guided(const MaterialModel& model) {
  const Scene scene(gap_box_over(model));
  const Trained trained = train(scene, 200'000);
  RenderSummary illumination, product;
  const Image reference = render_mode(scene, trained, RenderMode::bsdf, 2048, 77);
  const Image image =
      render_mode(scene, trained, RenderMode::product, 512, 5, &product, RouletteMode::none);
  render_mode(scene, trained, RenderMode::illumination, 512, 5, &illumination, RouletteMode::none);
  EXPECT_LT(std::abs(mean_z(image, reference)), 3.5);
  EXPECT_LT(share_beyond_three(image, reference), 0.02);
  EXPECT_LT(product.estimated_relmse, illumination.estimated_relmse);
}

TEST(SlowAnisotropicModes, ProductHasTheMeanOfPathTracingAndLessVarianceOverBrushedMetal) {
  RoughConductorMaterial metal;
  metal.alpha_u = Texture(0.05f), metal.alpha_v = Texture(0.3f);
  expect_anisotropy_is_guided(metal);
}

TEST(SlowAnisotropicModes, ProductHasTheMeanOfPathTracingAndLessVarianceOverWard) {
  WardMaterial ward;
  ward.diffuse_reflectance = Texture(0.0f), ward.specular_reflectance = Texture(0.8f);
  ward.alpha_u = Texture(0.3f), ward.alpha_v = Texture(0.05f);
  expect_anisotropy_is_guided(ward);
}

TEST(RenderFurnace, DiffuseSphereUnderConstantLightReflectsItsAlbedo) {
  SceneDescription description;
  const int grey = testing::add_material(description, "grey", DiffuseMaterial{Texture(0.8f)});
  testing::add_shape(description, Sphere{{0, 0, 3}, 1.0f, Mat3::Identity()}, grey);
  description.emitters.push_back(ConstantEnvironment{Color(1, 2, 3)});
  testing::look_along_z(description, {0, 0, 0}, 3, 3);
  description.sensor.fov = 0.1f;
  const Scene scene(std::move(description));
  RenderOptions options;
  options.spp = 16384;  // one standard deviation of a sample is a quarter of the radiance
  const Image image = render(scene, {}, options, nullptr, {});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(1, 1, c), 0.8 * (c + 1), 1e-3 * (c + 1));
}

TEST(RenderFurnace, ClosedBoxOfEmittersShowsTheGeometricSeries) {
  // Every wall emits 1 and reflects 0.5: radiance is 1 / (1 - 0.5) everywhere.
  SceneDescription description;
  const int grey = testing::add_material(description, "grey", DiffuseMaterial{Texture(0.5f)});
  const Vec3 corner(-1, -1, -1), x(2, 0, 0), y(0, 2, 0), z(0, 0, 2);
  for (const TriangleMesh& wall :
       {testing::rectangle(corner, z, x), testing::rectangle(corner + y, x, z),
        testing::rectangle(corner, y, z), testing::rectangle(corner + x, z, y),
        testing::rectangle(corner, x, y), testing::rectangle(corner + z, y, x)})
    testing::make_light(description, testing::add_shape(description, wall, grey), Color(1, 1, 1));
  testing::look_along_z(description, {0.1f, 0, -0.5f}, 4, 4);
  const Scene scene(std::move(description));
  RenderOptions options;
  options.spp = 1024;
  const Image image = render(scene, {}, options, nullptr, {});
  double mean = 0;
  for (const float value : image.pixels) mean += value / image.pixels.size();
  EXPECT_NEAR(mean, 2.0, 0.01);
}

TEST(RenderOptionsTest, WantsAStoppingRule) { EXPECT_THROW(RenderOptions{}.validate(), Misuse); }

}  // namespace
}  // namespace waylight
