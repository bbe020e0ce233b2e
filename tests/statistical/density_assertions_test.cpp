// The assertion itself must be able to fail.

#include "statistical/density_assertions.h"

#include <gtest/gtest-spi.h>

#include "libguide/math/warp.h"
#include "libguide/scene/cone.h"

namespace waylight::testing {
namespace {

std::optional<Vec3> cosine(Sampler& sampler) {
  return square_to_cosine_hemisphere(sampler.next_2d());
}

TEST(DensityAssertion, UpperGammaMatchesClosedForms) {
  for (double x : {0.1, 1.0, 3.0, 20.0}) {
    EXPECT_NEAR(upper_gamma(1, x), std::exp(-x), 1e-12);
    EXPECT_NEAR(upper_gamma(0.5, x), std::erfc(std::sqrt(x)), 1e-12);
    EXPECT_NEAR(upper_gamma(2, x), (1 + x) * std::exp(-x), 1e-12);
  }
}

TEST(DensityAssertion, RejectsADensityOfTheWrongShape) {
  const auto tilted = [](const Vec3& w) { return cosine_hemisphere_pdf(w) * (1 + 0.1f * w.x()); };
  EXPECT_NONFATAL_FAILURE(expect_valid_density(Sphere{}, "tilted", cosine, tilted), "chi-square");
}

TEST(DensityAssertion, RejectsADensityOfTheWrongIntegral) {
  const auto low = [](const Vec3& w) { return 0.99f * cosine_hemisphere_pdf(w); };
  EXPECT_NONFATAL_FAILURE(expect_valid_density(Sphere{}, "low", cosine, low), "integrates to");
}

TEST(DensityAssertion, AcceptsLostMassOnlyWhenTheDensityLacksIt) {
  const auto half = [](Sampler& sampler) -> std::optional<Vec3> {
    if (sampler.next() < 0.5f) return std::nullopt;
    return cosine(sampler);
  };
  expect_valid_density(Sphere{}, "sub-density", half,
                       [](const Vec3& w) { return 0.5f * cosine_hemisphere_pdf(w); });
  EXPECT_NONFATAL_FAILURE(expect_valid_density(Sphere{}, "full", half, cosine_hemisphere_pdf),
                          "integrates to");
}

TEST(DensityAssertion, RejectsDensitiesThatAreNotFinite) {
  const auto hole = [](const Vec3& w) {
    const float bad = w.x() > 0.9f ? std::nanf("") : 0.0f;
    return cosine_hemisphere_pdf(w) + bad;
  };
  const Sphere sphere;
  BoxIntegral<Sphere, decltype(hole)> integral(sphere, hole, 1e-6);
  for (const Box& root : sphere.roots()) integral(root);
  EXPECT_FALSE(integral.finite());
}

// A lobe of a thousandth of a radian is resolved by the adaptive bins.
TEST(DensityAssertion, ResolvesNarrowLobes) {
  constexpr float height = 5e-7f;
  const Vec3 axis = Vec3(0.3f, -0.4f, 0.7f).normalized();
  const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(Vec3::UnitZ(), axis);
  const auto sample = [&](Sampler& s) {
    return std::make_optional<Vec3>(turn * square_to_cone_of_height(s.next_2d(), height));
  };
  const auto pdf = [&](const Vec3& w) {
    const float distance = (w - axis).norm();
    return distance <= std::sqrt(2 * height) ? cone_of_height_pdf(height) : 0.0f;
  };
  DensityCheck check;
  check.tolerance = 1e-2;
  expect_valid_density(Sphere{}, "narrow", sample, pdf, check);
}

}  // namespace
}  // namespace waylight::testing
