// The fluence in media by path tracing, against closed forms, and that of cells against it.

#include <gtest/gtest.h>

#include "common/small_media.h"
#include "common/trained.h"

namespace waylight {
namespace {

using testing::box_of;
using testing::homogeneous;

const Color kLe(3, 2, 1);

RenderOptions slice_of(int spp, bool of_cache = false) {
  RenderOptions options;
  options.spp = spp;
  options.aovs.variance = true;
  options.fluence = FluenceSlice{2, 0.3f, of_cache};
  options.width = options.height = 12;
  return options;
}

struct Mean {
  double value = 0, sigma = 0;
};

Mean mean_of(const Image& image) {
  Mean mean;
  const double pixels = image.width * image.height;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      mean.value += image.at(x, y, 0) / pixels;
      mean.sigma += image.at(x, y, 3) / sqr(pixels);
    }
  mean.sigma = std::sqrt(mean.sigma);
  return mean;
}

void expect_mean(const Mean& mean, double expected, const std::string& what) {
  EXPECT_NEAR(mean.value, expected, 4 * mean.sigma + 3e-4 * expected) << what;
  EXPECT_LT(mean.sigma, 0.01 * expected) << what << ": says too little";
}

// In surroundings of radiance Le, media of albedo 1 and those that emit Le themselves.
TEST(Fluence, IsFourPiTimesTheRadianceInEquilibrium) {
  Medium glowing = homogeneous(Color(0.5f, 1, 4), Color(0.2f, 0.9f, 0.5f), 0.5f);
  glowing.emission.radiance = kLe;
  for (const Medium& medium : {homogeneous(Color::Constant(2), Color::Ones(), 0.5f), glowing,
                               testing::cloud(testing::lumpy_grid(), 8, 1)}) {
    SceneDescription description = box_of(medium, {0, 0, 0}, {1, 1, 1});
    description.emitters.push_back(ConstantEnvironment{kLe});
    const Scene scene(description);
    expect_mean(mean_of(render(scene, {}, slice_of(256), nullptr, {})), 4 * kPi * luminance(kLe),
                "equilibrium");
  }
}

// A lamp of radiance L that is a far sphere of solid angle w, in thin fog.
class LampInThinFog : public ::testing::Test {
 protected:
  static SceneDescription lit() {
    SceneDescription description =
        box_of(homogeneous(Color::Constant(1e-6f), Color::Zero()), {0, 0, 0}, {1, 1, 1});
    const int black = testing::add_material(description, "black", DiffuseMaterial{Texture(0.0f)});
    const uint32_t lamp = testing::add_shape(
        description, Sphere{Vec3(0.5f, 0.5f, 0.3f) + Vec3(0, 100, 0), 10.0f}, black);
    testing::make_light(description, lamp, kLe);
    return description;
  }

  const Scene scene_{lit()};
  const double expected_ = luminance(kLe) * 2 * kPi * (1 - std::sqrt(1 - 0.01));
};

TEST_F(LampInThinFog, FluenceIsItsRadianceTimesItsSolidAngle) {
  for (const int max_depth : {1, -1}) {
    RenderOptions options = slice_of(64);
    options.max_depth = max_depth;
    expect_mean(mean_of(render(scene_, {}, options, nullptr, {})), expected_, "lamp");
  }
}

// The disk has an area of 2 pi and 4 pi sr, so the square about it 8 and 16.
TEST_F(LampInThinFog, FluenceIsTheIntegralOfThePictureOfTheSphere) {
  RenderOptions options = slice_of(512);
  options.fluence.reset();
  options.sphere = Vec3(0.5f, 0.5f, 0.3f);
  options.width = options.height = 64;
  const Image image = render(scene_, {}, options, nullptr, {});
  Mean red = mean_of(image);
  for (double* figure : {&red.value, &red.sigma}) *figure *= 16 * luminance(kLe) / kLe.x();
  expect_mean(red, expected_, "sphere");
}

TEST(Fluence, IsTheSameInGuidedModes) {
  SceneDescription description =
      box_of(homogeneous(Color::Constant(3), Color::Constant(0.9f), 0.5f), {0, 0, 0}, {1, 1, 1});
  const uint32_t lamp = testing::add_shape(
      description, testing::rectangle({0, 1.5f, 0}, {1, 0, 0}, {0, 0, 1}),
      testing::add_material(description, "black", DiffuseMaterial{Texture(0.0f)}));
  testing::make_light(description, lamp, Color(9, 6, 5));
  const Scene scene(description);
  const testing::Trained trained = testing::train(scene, 200'000);
  const Mean plain = mean_of(render(scene, {}, slice_of(512), nullptr, {}));
  RenderOptions options = slice_of(256);
  options.distance = DistanceMode::guided;
  options.direction = PhaseMode::product;
  options.roulette = RouletteMode::guided;
  options.split = 4;
  options.seed = 7;
  const Mean guided = mean_of(render(scene, trained.caches(), options, nullptr, {}));
  EXPECT_NEAR(guided.value, plain.value, 4 * std::hypot(guided.sigma, plain.sigma));
  const Mean cells = mean_of(render(scene, trained.caches(), slice_of(16, true), nullptr, {}));
  EXPECT_NEAR(cells.value, plain.value, 0.03 * plain.value);
}

TEST(Fluence, OfCellsNeedsACacheOfMedia) {
  const Scene scene(box_of(homogeneous(Color::Ones(), Color::Zero()), {0, 0, 0}, {1, 1, 1}));
  EXPECT_ANY_THROW(render(scene, {}, slice_of(1, true), nullptr, {}));
  RenderOptions automatic = slice_of(1);
  automatic.mode = RenderMode::automatic;
  EXPECT_ANY_THROW(render(scene, {}, automatic, nullptr, {}));
}

}  // namespace
}  // namespace waylight
