#include "libguide/fit/lobe_distance.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

Bsdf phong(float diffuse, float specular, float exponent) {
  Bsdf bsdf;
  bsdf.add(Phong{Color::Constant(diffuse), Color::Constant(specular), exponent}, 1);
  return bsdf;
}

Bsdf diffuse(const Color& color) {
  Bsdf bsdf;
  bsdf.add(Diffuse{color}, 1);
  return bsdf;
}

const Vec3 kFrom = Vec3(0.6f, 0, 0.8f);

float distance(const Bsdf& a, const Bsdf& b) {
  return lobe_distance(LobeTarget(a, kFrom), LobeTarget(b, kFrom));
}

TEST(LobeDistance, IsZeroForLobesOfOneShape) {
  EXPECT_LT(distance(diffuse({0.1f, 0.9f, 0.3f}), diffuse({0.5f, 0.2f, 0.2f})), 1e-5f);
  EXPECT_LT(distance(phong(0.2f, 0.4f, 50), phong(0.1f, 0.2f, 50)), 1e-5f);
}

TEST(LobeDistance, GrowsWithTheDifferenceUpToTwo) {
  const Bsdf base = phong(0, 0.5f, 100);
  const float near = distance(base, phong(0, 0.5f, 110)), far = distance(base, phong(0, 0.5f, 300));
  EXPECT_GT(near, 0.03f);
  EXPECT_LT(near, 0.12f);
  EXPECT_GT(far, 0.5f);
  EXPECT_GT(distance(phong(0, 0.5f, 1e5f), diffuse(Color::Ones())), 1.9f);
  EXPECT_LE(distance(phong(0, 0.5f, 1e5f), diffuse(Color::Ones())), 2.0f);
}

TEST(LobeDistance, IsThatOfTwoGaussiansForNarrowPhongLobes) {
  // About the mirror direction the lobe of exponent n is a Gaussian of variance 2 / n. For two
  // widths the difference is 2 (q^(r2 / (r2 - 1)) - q^(1 / (r2 - 1))) with r2 the ratio of the
  // variances and q = 1 / r2, up to sign.
  const double r2 = 2;
  const double expected = 2 * (std::pow(1 / r2, 1 / (r2 - 1)) - std::pow(1 / r2, r2 / (r2 - 1)));
  EXPECT_NEAR(distance(phong(0, 0.5f, 1000), phong(0, 0.5f, 2000)), expected, 0.05 * expected);
}

TEST(LobeDistance, ABlackLobeIsFarFromAnyOther) {
  EXPECT_EQ(distance(diffuse(Color::Zero()), diffuse(Color::Ones())), 2);
  EXPECT_EQ(distance(diffuse(Color::Zero()), diffuse(Color::Zero())), 0);
}

}  // namespace
}  // namespace waylight
