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

TEST(MeanPicture, IsThatOfEachColor) {
  const std::vector<Bitmap> pictures = {pixel(1), pixel(2), pixel(6)};
  EXPECT_TRUE((mean_picture(pictures).pixels[0] == Color(3, 6, 5)).all());
}

TEST(MeanPicture, OfOneIsItself) {
  const std::vector<Bitmap> one = {pixel(0.1f)};
  EXPECT_TRUE((mean_picture(one).pixels[0] == one[0].pixels[0]).all());
}

TEST(MeanPicture, OfUnequalSizesOrOfNothingIsRefused) {
  const std::vector<Bitmap> pictures = {pixel(1), Bitmap{}};
  EXPECT_THROW(mean_picture(pictures), Misuse);
  EXPECT_THROW(mean_picture({}), Misuse);
}

}  // namespace
}  // namespace waylight
