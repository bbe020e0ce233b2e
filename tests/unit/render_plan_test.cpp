#include "libguide/render_plan.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"

namespace waylight {
namespace {

FilmDescription cropped(int width, int height) {
  FilmDescription film;
  film.width = 1920, film.height = 1080;
  film.crop_x = 900, film.crop_y = 500, film.crop_width = width, film.crop_height = height;
  return film;
}

TEST(RenderPlan, AWindowOfTheSceneKeepsItsProportionAndAtLeastAPixel) {
  RenderOptions options;
  options.width = 192, options.height = 108;
  const FilmDescription tenth = film_of(cropped(100, 50), options);
  EXPECT_EQ(tenth.crop_x, 90);
  EXPECT_EQ(tenth.crop_width, 10);
  EXPECT_EQ(tenth.crop_height, 5);
  options.width = 16, options.height = 9;
  const FilmDescription pixel = film_of(cropped(100, 50), options);
  EXPECT_EQ(pixel.crop_width, 1);
  EXPECT_EQ(pixel.crop_height, 1);
}

TEST(RenderPlan, AWindowBeyondTheFilmIsRefusedHoweverLargeItsNumbers) {
  RenderOptions options;
  options.crop_width = options.crop_height = 1;
  for (const int start : {-1, 1920, std::numeric_limits<int>::max()}) {
    options.crop_x = start;
    EXPECT_THROW(film_of(cropped(0, 0), options), Misuse) << start;
  }
}

TEST(RenderPlan, OptionsWithoutEffectAreRefused) {
  const auto refuses = [](const std::function<void(RenderOptions&)>& change) {
    RenderOptions options;
    options.spp = 1;
    options.mode = RenderMode::bsdf;
    change(options);
    EXPECT_THROW(options.validate(), Misuse);
  };
  refuses([](RenderOptions& o) { o.split = 2; });
  refuses([](RenderOptions& o) { o.weight_window = 20; });
  refuses([](RenderOptions& o) { o.pixel_estimate = PixelEstimateMode::preview; });
  refuses([](RenderOptions& o) { o.candidates = 4; });
  refuses([](RenderOptions& o) { o.share_rule = ShareRule::fixed; });
  refuses([](RenderOptions& o) { o.distance_bias = 2; });
  RenderOptions plain;
  plain.spp = 1;
  plain.mode = RenderMode::bsdf;
  EXPECT_NO_THROW(plain.validate());
}

}  // namespace
}  // namespace waylight
