#include "libguide/image/z_scores.h"

#include <gtest/gtest.h>

#include <random>

#include "libguide/base/error.h"

namespace waylight {
namespace {

Bitmap constant(int width, int height, float value) {
  Bitmap bitmap;
  bitmap.width = width;
  bitmap.height = height;
  bitmap.pixels.assign(static_cast<size_t>(width) * height, Color::Constant(value));
  return bitmap;
}

// Normal noise of a standard deviation that varies over the picture.
struct NoisyPair {
  Bitmap image = constant(256, 200, 1), reference = image, variance = image;

  explicit NoisyPair(float bias = 0) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (size_t i = 0; i < image.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const float sigma = 0.01f * static_cast<float>(1 + i % 7);
        image.pixels[i][c] += sigma * normal(random) + bias;
        variance.pixels[i][c] = sigma * sigma;
      }
  }
};

TEST(ZScores, OfNormalNoiseAreStandardNormal) {
  const NoisyPair pair;
  const ZScores z = z_scores(pair.image, pair.reference, pair.variance);
  EXPECT_EQ(z.pixels.count, 256u * 200 * 3);
  EXPECT_EQ(z.tiles.count, 32u * 25 * 3);
  for (const ZDistribution* d : {&z.pixels, &z.tiles}) {
    const double n = static_cast<double>(d->count);
    EXPECT_NEAR(d->mean, 0, 4 / std::sqrt(n));
    EXPECT_NEAR(d->stddev, 1, 4 / std::sqrt(2 * n));
    EXPECT_NEAR(double(d->beyond2), d->expected2(), 4 * std::sqrt(d->expected2()));
    EXPECT_NEAR(double(d->beyond3), d->expected3(), 4 * std::sqrt(d->expected3()) + 1);
    EXPECT_EQ(d->unexplained, 0u);
  }
}

TEST(ZScores, TilesShowABiasThatPixelsHide) {
  const NoisyPair pair(0.015f);  // half of a typical sigma
  const ZScores z = z_scores(pair.image, pair.reference, pair.variance);
  EXPECT_LT(double(z.pixels.beyond3), 0.1 * double(z.pixels.count));
  EXPECT_GT(double(z.tiles.beyond3), 0.3 * double(z.tiles.count));
  EXPECT_GT(z.tiles.mean, 2);
}

TEST(ZScores, AFloorTakesDifferencesForNoiseThatAreSmallerThanIt) {
  const Bitmap image = constant(16, 16, 0.01f), reference = constant(16, 16, 0),
               variance = constant(16, 16, 0);
  EXPECT_EQ(z_scores(image, reference, variance).tiles.unexplained, 12u);
  const ZScores z = z_scores(image, reference, variance, 8, 0.01);
  EXPECT_EQ(z.tiles.count, 12u);
  EXPECT_NEAR(z.tiles.largest, 1, 1e-6);
  EXPECT_NEAR(z.pixels.largest, 1, 1e-6);
}

TEST(ZScores, OfOnePixelAreTheDifferenceInSigmas) {
  Bitmap image = constant(1, 1, 0), variance = image;
  image.pixels[0] = Color(3, -1, 0);
  variance.pixels[0] = Color(4, 0.04f, 1);
  const ZDistribution z = z_scores(image, constant(1, 1, 0), variance).pixels;
  EXPECT_EQ(z.count, 3u);
  EXPECT_EQ(z.beyond2, 1u);
  EXPECT_EQ(z.beyond3, 1u);
  EXPECT_NEAR(z.largest, 5, 1e-5);
  EXPECT_NEAR(z.mean, (1.5 - 5 + 0) / 3, 1e-5);
}

TEST(ZScores, SmallerTilesAtTheBorderCount) {
  const Bitmap one = constant(17, 9, 1);
  EXPECT_EQ(z_scores(one, one, one, 8).tiles.count, 3u * 2 * 3);
  EXPECT_EQ(z_scores(one, one, one, 100).tiles.count, 3u);
}

TEST(ZScores, DifferencesWithoutVarianceAreUnexplained) {
  Bitmap image = constant(4, 4, 1);
  image.pixels[5] = Color(1, 2, 1);
  const ZScores z = z_scores(image, constant(4, 4, 1), constant(4, 4, 0));
  EXPECT_EQ(z.pixels.count, 0u);
  EXPECT_EQ(z.pixels.unexplained, 1u);
  EXPECT_EQ(z.tiles.unexplained, 1u);
  EXPECT_EQ(z.pixels.stddev, 0);
}

TEST(ZScores, PixelsThatAreNotFiniteHaveNoScore) {
  Bitmap image = constant(2, 1, 1);
  image.pixels[0][2] = std::numeric_limits<float>::quiet_NaN();
  const ZScores z = z_scores(image, constant(2, 1, 1), constant(2, 1, 1));
  EXPECT_EQ(z.pixels.count, 3u);
  EXPECT_TRUE(std::isfinite(z.tiles.mean));
}

TEST(ZScores, WrongInputsAreRefused) {
  const Bitmap one = constant(2, 2, 1);
  EXPECT_THROW(z_scores(one, constant(2, 3, 1), one), Misuse);
  EXPECT_THROW(z_scores(one, one, constant(1, 1, 1)), Misuse);
  EXPECT_THROW(z_scores(one, one, one, 0), Misuse);
  EXPECT_THROW(z_scores(one, one, constant(2, 2, -1)), Error);
}

}  // namespace
}  // namespace waylight
