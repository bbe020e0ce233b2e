#include "libguide/image/texture.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

// Two by two grey pixels, top row 1 2, bottom row 3 4.
BitmapTexture four_pixels() {
  Bitmap bitmap;
  bitmap.width = bitmap.height = 2;
  for (float v : {1.0f, 2.0f, 3.0f, 4.0f}) bitmap.pixels.push_back(Color::Constant(v));
  return {std::make_shared<Bitmap>(bitmap)};
}

Texture textured(const BitmapTexture& bitmap) {
  Texture texture;
  texture.source = bitmap;
  return texture;
}

TEST(Texture, PixelCentresAreExactAndTheBottomRowIsAtVZero) {
  for (TextureFilter filter : {TextureFilter::bilinear, TextureFilter::nearest}) {
    BitmapTexture bitmap = four_pixels();
    bitmap.filter = filter;
    const Texture texture = textured(bitmap);
    EXPECT_FLOAT_EQ(texture.eval({0.25f, 0.25f}).x(), 3);
    EXPECT_FLOAT_EQ(texture.eval({0.75f, 0.25f}).x(), 4);
    EXPECT_FLOAT_EQ(texture.eval({0.25f, 0.75f}).x(), 1);
    EXPECT_FLOAT_EQ(texture.eval({0.75f, 0.75f}).x(), 2);
  }
}

TEST(Texture, BilinearInterpolatesBetweenCentres) {
  const Texture texture = textured(four_pixels());
  EXPECT_FLOAT_EQ(texture.eval({0.5f, 0.5f}).x(), 2.5f);
  EXPECT_FLOAT_EQ(texture.eval({0.5f, 0.25f}).x(), 3.5f);
  EXPECT_FLOAT_EQ(texture.eval({0.375f, 0.75f}).x(), 1.25f);
}

TEST(Texture, WrapModesAtAndBeyondTheEdge) {
  struct Case {
    WrapMode mode;
    float at_edge, beyond;  // at u = 0 and u = 1.25 along the bottom row 3 4
  };
  for (const Case& c :
       {Case{WrapMode::repeat, 3.5f, 3}, Case{WrapMode::mirror, 3, 4}, Case{WrapMode::clamp, 3, 4},
        Case{WrapMode::zero, 1.5f, 0}, Case{WrapMode::one, 2, 1}}) {
    BitmapTexture bitmap = four_pixels();
    bitmap.wrap_u = c.mode;
    const Texture texture = textured(bitmap);
    EXPECT_FLOAT_EQ(texture.eval({0, 0.25f}).x(), c.at_edge) << int(c.mode);
    EXPECT_FLOAT_EQ(texture.eval({1.25f, 0.25f}).x(), c.beyond) << int(c.mode);
  }
}

TEST(Texture, RepeatAndMirrorArePeriodic) {
  for (WrapMode mode : {WrapMode::repeat, WrapMode::mirror}) {
    BitmapTexture bitmap = four_pixels();
    bitmap.wrap_u = bitmap.wrap_v = mode;
    const Texture texture = textured(bitmap);
    for (float u : {-0.9f, -0.1f, 0.3f, 0.99f})
      EXPECT_NEAR(texture.eval({u, 0.1f}).x(), texture.eval({u + 4, -5.9f}).x(), 1e-4f) << u;
  }
}

TEST(Texture, CoordinatesThatAreHugeOrNotFiniteAreSafe) {
  for (WrapMode mode : {WrapMode::repeat, WrapMode::mirror, WrapMode::clamp, WrapMode::zero})
    for (float bad : {1e30f, -1e30f, kInfinity, std::nanf("")}) {
      BitmapTexture bitmap = four_pixels();
      bitmap.wrap_u = bitmap.wrap_v = mode;
      const float value = textured(bitmap).eval({bad, bad}).x();
      EXPECT_TRUE(value >= 0 && value <= 4) << bad;
    }
}

TEST(Texture, CheckerboardStartsWithTheFirstColour) {
  Texture texture;
  texture.source = CheckerboardTexture{Color::Zero(), Color::Ones()};
  EXPECT_EQ(texture.eval({0.2f, 0.2f}).x(), 0);
  EXPECT_EQ(texture.eval({0.7f, 0.2f}).x(), 1);
  EXPECT_EQ(texture.eval({0.2f, 0.7f}).x(), 1);
  EXPECT_EQ(texture.eval({0.7f, 0.7f}).x(), 0);
  EXPECT_EQ(texture.eval({-0.2f, 0.2f}).x(), 1);
  EXPECT_FLOAT_EQ(texture.mean().x(), 0.5f);
}

TEST(Texture, ScaleAndTransformApply) {
  Texture texture = textured(four_pixels());
  texture.scale = 3;
  texture.to_uv.m = {0, 1, 0, 1, 0, 0};  // swaps u and v
  EXPECT_FLOAT_EQ(texture.eval({0.25f, 0.75f}).x(), 12);
  EXPECT_FLOAT_EQ(texture.eval_scalar({0.75f, 0.25f}), 3);
  EXPECT_FLOAT_EQ(texture.mean().x(), 7.5f);
  Texture constant(Color(1, 2, 3));
  constant.scale = 2;
  EXPECT_FLOAT_EQ(constant.eval_scalar({0, 0}), 4);
  EXPECT_FLOAT_EQ(constant.mean().z(), 6);
}

// A ramp: value i at column i, 8 per unit of u; the gradient follows the chain rule.
TEST(Texture, GradientOfARampThroughATransform) {
  Bitmap bitmap;
  bitmap.width = bitmap.height = 8;
  for (int i = 0; i < 64; ++i) bitmap.pixels.push_back(Color::Constant(i % 8));
  Texture texture = textured({std::make_shared<Bitmap>(bitmap)});
  EXPECT_NEAR(texture.gradient({0.4f, 0.3f}).x(), 8, 1e-3f);
  EXPECT_NEAR(texture.gradient({0.4f, 0.3f}).y(), 0, 1e-3f);
  texture.scale = 0.5f;
  texture.to_uv.m = {0.5f, 0.25f, 0.1f, 0.3f, 2, 0};
  const Vec2 at(0.4f, 0.3f), gradient = texture.gradient(at);
  const float h = 1e-3f;
  for (int axis : {0, 1}) {
    const Vec2 step = h * Vec2::Unit(axis);
    const float difference = texture.eval_scalar(at + step) - texture.eval_scalar(at - step);
    EXPECT_NEAR(gradient[axis], difference / (2 * h), 2e-3f) << axis;
  }
}

}  // namespace
}  // namespace waylight
