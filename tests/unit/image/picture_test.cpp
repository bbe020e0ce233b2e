#include "libguide/image/picture.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"

namespace waylight {
namespace {

// Pixel (x, y) is (x, y, x y).
Bitmap ramp(int width, int height) {
  Bitmap bitmap;
  bitmap.width = width;
  bitmap.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      bitmap.pixels.push_back(Color(float(x), float(y), float(x) * float(y)));
  return bitmap;
}

TEST(Crop, KeepsTheWindow) {
  const Bitmap part = crop(ramp(9, 7), {2, 3, 4, 2});
  ASSERT_EQ(part.width, 4);
  ASSERT_EQ(part.height, 2);
  EXPECT_TRUE((part.at(0, 0) == Color(2, 3, 6)).all());
  EXPECT_TRUE((part.at(3, 1) == Color(5, 4, 20)).all());
}

TEST(Crop, WindowsThatReachOutsideAreMisuse) {
  const Bitmap image = ramp(9, 7);
  for (const PixelWindow window : {PixelWindow{-1, 0, 2, 2},
                                   {0, 0, 10, 1},
                                   {0, 0, 1, 8},
                                   {9, 0, 1, 1},
                                   {0, 0, 0, 1},
                                   {1 << 30, 0, 1 << 30, 1}})
    EXPECT_THROW(crop(image, window), Misuse) << window.x << " " << window.width;
}

TEST(Downsample, ByAnIntegerIsTheMeanOfBlocks) {
  const Bitmap half = downsample(ramp(8, 6), 4, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) {
      EXPECT_FLOAT_EQ(half.at(x, y)[0], 2 * float(x) + 0.5f);
      EXPECT_FLOAT_EQ(half.at(x, y)[1], 2 * float(y) + 0.5f);
    }
}

TEST(Downsample, ByAFractionSplitsPixelsByArea) {
  const Bitmap small = downsample(ramp(3, 3), 2, 2);  // a pixel covers 1.5
  EXPECT_FLOAT_EQ(small.at(0, 0)[0], (0 + 0.5f * 1) / 1.5f);
  EXPECT_FLOAT_EQ(small.at(1, 0)[0], (0.5f * 1 + 2) / 1.5f);
}

TEST(Downsample, KeepsTheMean) {
  const Bitmap image = ramp(13, 11);
  const Bitmap small = downsample(image, 7, 6);
  Color before = Color::Zero(), after = Color::Zero();
  for (const Color& c : image.pixels) before += c / float(image.pixels.size());
  for (const Color& c : small.pixels) after += c / float(small.pixels.size());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-5);
}

TEST(Downsample, VarianceOfTheMeanOfFourPixelsIsAQuarter) {
  Bitmap variance = ramp(4, 4);
  for (Color& c : variance.pixels) c.setConstant(2);
  const Bitmap small = downsample(variance, 2, 2, PixelQuantity::variance);
  EXPECT_FLOAT_EQ(small.at(1, 1)[0], 0.5f);
}

TEST(Downsample, EqualSizeChangesNothing) {
  const Bitmap image = ramp(5, 4), same = downsample(image, 5, 4);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_TRUE((image.pixels[i] == same.pixels[i]).all());
}

TEST(Downsample, EnlargingAndOtherProportionsAreMisuse) {
  EXPECT_THROW(downsample(ramp(8, 6), 16, 12), Misuse);
  EXPECT_THROW(downsample(ramp(80, 60), 40, 10), Misuse);
  EXPECT_THROW(downsample(ramp(8, 6), 0, 0), Misuse);
  EXPECT_NO_THROW(downsample(ramp(1280, 853), 640, 427));
}

TEST(ColorOf, TakesChannelsByNameWhateverTheirOrder) {
  Image image(1, 1, {"variance.B", "B", "G", "R", "variance.R", "variance.G"});
  image.pixels = {6, 3, 2, 1, 4, 5};
  EXPECT_TRUE((color_of(image).at(0, 0) == Color(1, 2, 3)).all());
  EXPECT_TRUE((color_of(image, "variance.").at(0, 0) == Color(4, 5, 6)).all());
  EXPECT_FALSE(has_color(image, "albedo."));
  EXPECT_THROW(color_of(image, "albedo."), Error);
}

}  // namespace
}  // namespace waylight
