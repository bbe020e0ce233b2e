#include "formats/mitsuba/content_fixture.h"

namespace waylight::mitsuba {
namespace {

TEST(MitsubaSpectra, AFlatReflectanceIsWhite) {
  expect_color(spectrum_to_rgb({{300, 1}, {900, 1}}), Color::Ones(), 1e-3f);
  expect_color(spectrum_to_rgb({{300, 0.25f}, {500, 0.25f}, {900, 0.25f}}), Color::Constant(0.25f),
               1e-3f);
}

TEST(MitsubaSpectra, BandsHaveTheirColours) {
  const Color red = spectrum_to_rgb({{600, 0}, {601, 1}, {780, 1}});
  const Color green = spectrum_to_rgb({{500, 0}, {501, 1}, {570, 1}, {571, 0}});
  const Color blue = spectrum_to_rgb({{380, 1}, {480, 1}, {481, 0}});
  EXPECT_GT(red.x(), 5 * red.y());
  EXPECT_GT(green.y(), 2 * green.z());
  EXPECT_GT(blue.z(), 5 * blue.y());
  for (const Color& c : {red, green, blue}) EXPECT_GE(c.minCoeff(), 0);
}

TEST(MitsubaSpectra, IsZeroOutsideOfItsWavelengths) {
  expect_color(spectrum_to_rgb({{100, 1}, {200, 1}}), Color::Zero());
}

// The colour temperature of D65 is 6504 K; Planck's spectrum there lies a little off D65.
TEST(MitsubaSpectra, BlackbodiesRunFromRedToBlueThroughWhite) {
  const Color white = blackbody_rgb(6504, 1);
  EXPECT_LT((white / white.mean() - 1).abs().maxCoeff(), 0.06f);
  const Color candle = blackbody_rgb(1900, 1), sky = blackbody_rgb(20000, 1);
  EXPECT_TRUE(candle.x() > candle.y() && candle.y() > candle.z());
  EXPECT_TRUE(sky.x() < sky.y() && sky.y() < sky.z());
}

// The maximum of Planck's law at 6504 K is 4.095e-6 T^5 W / (m^2 sr m), at 446 nm; the mean that
// the eye sees is a little below.
TEST(MitsubaSpectra, BlackbodiesHaveTheRadianceOfPlancksLaw) {
  const double most = 4.0957e-6 * std::pow(6504.0, 5) * 1e-9;
  const float seen = luminance(blackbody_rgb(6504, 1));
  EXPECT_TRUE(seen < most && seen > 0.8 * most) << seen << ' ' << most;
  expect_color(blackbody_rgb(3000, 2) / blackbody_rgb(3000, 1), Color::Constant(2));
}

}  // namespace
}  // namespace waylight::mitsuba
