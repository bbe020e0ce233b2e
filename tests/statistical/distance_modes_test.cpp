// Every way to sample distances in media has the mean of the standard one.

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "common/trained.h"

namespace waylight {
namespace {

const std::map<std::string, DistanceMode> kModes = {{"guided", DistanceMode::guided},
                                                    {"probability", DistanceMode::probability},
                                                    {"equiangular", DistanceMode::equiangular},
                                                    {"exponential", DistanceMode::exponential}};

// A lamp over a box of a medium, before a wall that half of the rays end at.
SceneDescription lamp_over(const Medium& medium) {
  SceneDescription scene = testing::box_of(medium, {0, 0, 0}, {1, 1, 1});
  const int white = testing::add_two_sided(scene, "white", DiffuseMaterial{Texture(0.5f)});
  testing::add_shape(scene, testing::rectangle({0, 0, 1.5f}, {0, 1, 0}, {0.5f, 0, 0}), white);
  const uint32_t lamp =
      testing::add_shape(scene, testing::rectangle({-1, 1.5f, -1}, {3, 0, 0}, {0, 0, 3}), white);
  testing::make_light(scene, lamp, Color(9, 6, 5));
  testing::look_along_z(scene, {0.5f, 0.5f, -1}, 16, 16);
  scene.sensor.fov = 0.7f;
  scene.integrator.max_depth = 4;
  return scene;
}

testing::Trained train_media(const Scene& scene) {
  PhotonTraceOptions trace;
  trace.count = 100'000;
  PhotonStreamInfo info{scene.bounds(), trace.count, 0};
  info.media = true;
  CacheTrainer trainer({}, info);
  const auto consume = [&](const auto& batch) { trainer.consume(batch); };
  trace_photons(scene, trace, consume, {}, {}, {}, consume);
  return {{}, trainer.finish(nullptr)};
}

Image render_with(const Scene& scene, const testing::Trained& trained, DistanceMode mode,
                  float bias = 0.5f) {
  RenderOptions options;
  options.spp = 512;
  options.distance = mode;
  options.distance_bias = bias;
  options.aovs.variance = true;
  options.seed = static_cast<uint64_t>(mode) + static_cast<uint64_t>(100 * bias);
  return render(scene, trained.caches(), options, nullptr, {});
}

// Of the image, channel by channel.
void expect_equal_means(const Image& a, const Image& b, const std::string& name) {
  for (int c = 0; c < 3; ++c) {
    double mean = 0, difference = 0, variance = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        mean += b.at(x, y, c);
        difference += a.at(x, y, c) - b.at(x, y, c);
        variance += a.at(x, y, 3 + c) + b.at(x, y, 3 + c);
      }
    EXPECT_LT(std::abs(difference), 4 * std::sqrt(variance)) << name << " channel " << c;
    EXPECT_LT(std::sqrt(variance), 0.01 * mean) << name << ": says too little";
  }
}

void expect_one_mean(SceneDescription description) {
  const Scene scene(std::move(description));
  const testing::Trained trained = train_media(scene);
  ASSERT_GT(trained.guide.medium.cells.size(), 1);
  const Image standard = render_with(scene, trained, DistanceMode::standard);
  for (const auto& [name, mode] : kModes)
    expect_equal_means(render_with(scene, trained, mode), standard, name);
  const Image compressed = render_with(scene, trained, DistanceMode::exponential, 3);
  expect_equal_means(compressed, standard, "bias 3");
}

TEST(DistanceModes, HaveOneMeanInFog) {
  expect_one_mean(
      lamp_over(testing::homogeneous(Color::Constant(0.6f), Color::Constant(0.9f), 0.4f)));
}

TEST(DistanceModes, HaveOneMeanInColouredFog) {
  expect_one_mean(lamp_over(testing::homogeneous(Color(0.4f, 1, 4), Color(0.9f, 0.8f, 0.95f))));
}

TEST(DistanceModes, HaveOneMeanInClouds) {
  expect_one_mean(lamp_over(testing::cloud(testing::lumpy_grid(), 8)));
  expect_one_mean(lamp_over(testing::cloud(testing::lumpy_grid(3), 8)));
}

TEST(DistanceModes, TheGuidedOnesNeedACacheOfMedia) {
  const Scene scene(lamp_over(testing::homogeneous(Color::Constant(0.6f), Color::Constant(0.9f))));
  for (const DistanceMode mode : {DistanceMode::guided, DistanceMode::probability})
    EXPECT_ANY_THROW(render_with(scene, {}, mode));
  for (const DistanceMode mode : {DistanceMode::equiangular, DistanceMode::exponential})
    EXPECT_NO_THROW(render_with(scene, {}, mode));
  EXPECT_ANY_THROW(render_with(scene, {}, DistanceMode::exponential, 0));
  EXPECT_ANY_THROW(render_with(scene, {}, DistanceMode::exponential, 10.5f));
}

TEST(DistanceModes, EquiangularSaysOnceWhereItIsStandard) {
  const Scene scene(lamp_over(testing::cloud(testing::lumpy_grid(), 8)));
  int warnings = 0;
  RunControl control;
  control.on_warning = [&](const std::string&) { ++warnings; };
  RenderOptions options;
  options.spp = 1;
  options.distance = DistanceMode::equiangular;
  const Image equiangular = render(scene, {}, options, nullptr, control);
  options.distance = DistanceMode::standard;
  const Image standard = render(scene, {}, options, nullptr, control);
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(equiangular.at(8, 8, 0), standard.at(8, 8, 0));
}

}  // namespace
}  // namespace waylight
