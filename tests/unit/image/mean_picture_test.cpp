#include "libguide/image/mean_picture.h"

#include <gtest/gtest.h>

#include "libguide/base/error.h"

namespace waylight {
namespace {

Bitmap pixel(float value) {
  Bitmap bitmap;
  bitmap.width = bitmap.height = 1;
  bitmap.pixels = {Color(value, 2 * value, 5)};
  return bitmap;
}

TEST(MeanPicture, HasTheVarianceOfTheMean) {
  const std::vector<Bitmap> pictures = {pixel(1), pixel(2), pixel(6)};
  const MeanPicture result = mean_picture(pictures);
  EXPECT_TRUE(result.mean.pixels[0].isApprox(Color(3, 6, 5)));
  // (4 + 1 + 9) / (3 * 2)
  EXPECT_TRUE(result.variance.pixels[0].isApprox(Color(7.0f / 3, 28.0f / 3, 0)));
}

TEST(MeanPicture, OfOneIsItselfWithoutVariance) {
  const std::vector<Bitmap> one = {pixel(0.1f)};
  const MeanPicture result = mean_picture(one);
  EXPECT_TRUE((result.mean.pixels[0] == one[0].pixels[0]).all());
  EXPECT_TRUE((result.variance.pixels[0] == 0).all());
}

TEST(MeanPicture, OfUnequalSizesOrOfNothingIsRefused) {
  std::vector<Bitmap> pictures = {pixel(1), Bitmap{}};
  EXPECT_THROW(mean_picture(pictures), Misuse);
  EXPECT_THROW(mean_picture({}), Misuse);
}

}  // namespace
}  // namespace waylight
