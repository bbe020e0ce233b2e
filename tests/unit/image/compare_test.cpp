#include "libguide/image/compare.h"

#include <gtest/gtest.h>

#include <random>

#include "libguide/base/error.h"

namespace waylight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Bitmap picture(int width, int height, const Color& color) {
  Bitmap bitmap;
  bitmap.width = width;
  bitmap.height = height;
  bitmap.pixels.assign(static_cast<size_t>(width) * height, color);
  return bitmap;
}

TEST(Compare, EqualPicturesHaveNoError) {
  const Bitmap image = picture(7, 5, Color(0.1f, 2, 0));
  const CompareFigures figures = compare(image, image);
  EXPECT_EQ(figures.mse, 0);
  EXPECT_EQ(figures.relmse, 0);
  EXPECT_EQ(figures.relmse_trimmed, 0);
  EXPECT_EQ(figures.mape, 0);
  EXPECT_EQ(figures.mean_ratio(), 1);
  EXPECT_EQ(figures.pixels, 35u);
}

TEST(Compare, FiguresOfConstantPicturesAreAnalytic) {
  const CompareFigures figures =
      compare(picture(4, 3, Color(1.5f, 0.5f, 0.25f)), picture(4, 3, Color(1, 0.5f, 0)));
  EXPECT_NEAR(figures.mse, (0.25 + 0 + 0.0625) / 3, 1e-9);
  EXPECT_NEAR(figures.relmse, (0.25 / 1.01 + 0.0625 / 0.01) / 3, 1e-9);
  EXPECT_NEAR(figures.relmse_trimmed, figures.relmse, 1e-9);
  EXPECT_NEAR(figures.mape, (0.5 / 1.01 + 0.25 / 0.01) / 3, 1e-9);
  EXPECT_NEAR(figures.mean, 0.75, 1e-9);
  EXPECT_NEAR(figures.ref_mean, 0.5, 1e-9);
  EXPECT_NEAR(figures.mean_ratio(), 1.5, 1e-9);
}

TEST(Compare, ErrorWithoutTheNoiseOfTheReferenceIsThatAgainstTheTruth) {
  constexpr int kSide = 200;
  std::mt19937 random(3);
  std::normal_distribution<float> of_image(0, 0.2f), of_reference(0, 0.3f);
  Bitmap image = picture(kSide, kSide, Color::Ones()), reference = image;
  for (Color& color : image.pixels) color += of_image(random);
  for (Color& color : reference.pixels) color += of_reference(random);
  const Bitmap noise = picture(kSide, kSide, Color::Constant(0.09f));
  EXPECT_NEAR(compare(image, reference).mse, 0.04 + 0.09, 0.003);
  EXPECT_NEAR(compare(image, reference, &noise).mse, 0.04, 0.003);
}

TEST(Compare, PixelsWhoseNoiseIsNotFiniteAreLeftOut) {
  const Bitmap image = picture(2, 2, Color::Ones());
  Bitmap noise = picture(2, 2, Color::Constant(0.5f));
  noise.pixels[1][2] = kNaN;
  const CompareFigures figures = compare(image, image, &noise);
  EXPECT_EQ(figures.pixels, 3u);
  EXPECT_NEAR(figures.mse, -0.5, 1e-9);
}

TEST(Compare, TrimmedFigureLeavesOutOnePixelOfAThousand) {
  const Bitmap reference = picture(100, 20, Color::Ones());
  Bitmap image = picture(100, 20, Color::Constant(1.1f));
  image.pixels[3] = image.pixels[1700] = Color::Constant(1e4f);
  const CompareFigures figures = compare(image, reference);
  EXPECT_NEAR(figures.relmse_trimmed, 0.01 / 1.01, 1e-6);
  EXPECT_NEAR(figures.relmse, (2 * 9999.0 * 9999.0 + 1998 * 0.01) / 2000 / 1.01, 1);
  image.pixels[1800] = Color::Constant(1e4f);  // a third outlier is one more than 0.1 %
  EXPECT_GT(compare(image, reference).relmse_trimmed, 1e4);
}

TEST(Compare, FewerThanAThousandPixelsAreNotTrimmed) {
  Bitmap image = picture(30, 30, Color::Ones());
  image.pixels[0] = Color::Constant(2);
  const CompareFigures figures = compare(image, picture(30, 30, Color::Ones()));
  EXPECT_EQ(figures.relmse, figures.relmse_trimmed);
}

TEST(Compare, PixelsThatAreNotFiniteAreCountedAndLeftOut) {
  Bitmap image = picture(2, 2, Color::Constant(3)), reference = picture(2, 2, Color::Ones());
  image.pixels[0] = Color(1, kNaN, 1);
  reference.pixels[3] = Color(kInfinity, 1, 1);
  const CompareFigures figures = compare(image, reference);
  EXPECT_EQ(figures.non_finite, 2u);
  EXPECT_EQ(figures.pixels, 2u);
  EXPECT_EQ(figures.mse, 4);
  EXPECT_EQ(figures.mean, 3);
}

TEST(Compare, NothingFiniteIsAnError) {
  EXPECT_THROW(compare(picture(2, 2, Color::Constant(kNaN)), picture(2, 2, Color::Ones())), Error);
}

TEST(Compare, DifferentSizesAreMisuse) {
  EXPECT_THROW(compare(picture(2, 3, Color::Ones()), picture(3, 2, Color::Ones())), Misuse);
  EXPECT_THROW(relative_errors(picture(2, 3, Color::Ones()), picture(3, 2, Color::Ones())), Misuse);
}

TEST(FalseColor, EqualRatiosAreEqualStepsAndEndsAreClamped) {
  const Bitmap colors = false_color({0, 1e-4f, 1e-2f, 1, 100, kNaN}, 6, 1);
  EXPECT_TRUE((colors.pixels[0] == Color(0, 0, 0)).all());
  EXPECT_LT(colors.pixels[1].maxCoeff(), 1e-5f);
  EXPECT_TRUE((colors.pixels[3] == colors.pixels[4]).all());
  EXPECT_GT(luminance(colors.pixels[2]), luminance(colors.pixels[1]));
  EXPECT_GT(luminance(colors.pixels[3]), luminance(colors.pixels[2]));
  EXPECT_TRUE((colors.pixels[5] == Color(0, 1, 0)).all());
}

TEST(FalseColor, LuminanceRisesWithTheError) {
  std::vector<float> errors;
  for (int i = 0; i <= 100; ++i) errors.push_back(std::pow(10.0f, -4 + 0.04f * i));
  const Bitmap colors = false_color(errors, 101, 1);
  for (size_t i = 1; i < errors.size(); ++i)
    EXPECT_GE(luminance(colors.pixels[i]), luminance(colors.pixels[i - 1])) << errors[i];
}

TEST(RelativeErrors, AreTheTermsOfRelMse) {
  Bitmap image = picture(3, 1, Color::Ones());
  image.pixels[1] = Color(2, 1, 1);
  const std::vector<float> errors = relative_errors(image, picture(3, 1, Color::Ones()));
  EXPECT_FLOAT_EQ(errors[0], 0);
  EXPECT_FLOAT_EQ(errors[1], 1 / 1.01f / 3);
  EXPECT_FLOAT_EQ(errors[2], 0);
}

}  // namespace
}  // namespace waylight
