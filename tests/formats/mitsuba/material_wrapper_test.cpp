#include "formats/mitsuba/content_fixture.h"

namespace waylight::mitsuba {
namespace {

const std::string kGrey = "<bsdf type=\"diffuse\"/>";
const std::string kGlass = "<bsdf type=\"dielectric\"/>";
const std::string kHeight = "<texture type=\"checkerboard\"/>";

TEST(MitsubaWrappers, TwoSidedShowsOneMaterialOnBothSidesOrTwo) {
  for (const Dialect dialect : kBoth) {
    const auto same = Content(dialect).material<TwoSidedMaterial>(with_type("twosided", kGrey));
    EXPECT_EQ(same.front, 0);
    EXPECT_EQ(same.back, 0);
    const auto two =
        Content(dialect).material<TwoSidedMaterial>(with_type("twosided", kGrey + kGrey));
    EXPECT_EQ(two.front, 0);
    EXPECT_EQ(two.back, 1);
  }
}

TEST(MitsubaWrappers, TwoSidedRefusesWhatLightPassesThrough) {
  for (const Dialect dialect : kBoth)
    for (const std::string& nested :
         {kGlass, with_type("thindielectric"), with_type("roughdielectric"), with_type("null"),
          with_type("mask", kGrey), with_type("bumpmap", kHeight + kGlass),
          with_type("blendbsdf", kGrey + kGlass)}) {
      const std::string error = Content(dialect).error_of(with_type("twosided", nested));
      EXPECT_NE(error.find("lets light through"), std::string::npos) << nested << error;
    }
}

TEST(MitsubaWrappers, MaskAndBlendAreHalfByDefault) {
  for (const Dialect dialect : kBoth) {
    EXPECT_EQ(Content(dialect).material<MaskMaterial>(with_type("mask", kGrey)).opacity.mean().x(),
              0.5f);
    const auto blend =
        Content(dialect).material<BlendMaterial>(with_type("blendbsdf", kGrey + kGlass));
    EXPECT_EQ(blend.first, 0);
    EXPECT_EQ(blend.second, 1);
    EXPECT_EQ(blend.weight.mean().x(), 0.5f);
  }
  const auto mask = Content(Dialect::current)
                        .material<MaskMaterial>(with_type(
                            "mask", kGrey + "<texture type=\"checkerboard\" name=\"opacity\"/>"));
  EXPECT_FALSE(mask.opacity.constant());
}

TEST(MitsubaWrappers, BumpMapScalesItsHeightInTheWayOfItsDialect) {
  const auto current = Content(Dialect::current)
                           .material<BumpMapMaterial>(with_type(
                               "bumpmap", kHeight + kGrey + "<float name=\"scale\" value=\"3\"/>"));
  EXPECT_EQ(current.height.scale, 3);
  const auto old = Content(Dialect::old)
                       .material<BumpMapMaterial>(with_type(
                           "bumpmap", kGrey + "<texture type=\"scale\">" + kHeight +
                                          "<float name=\"scale\" value=\"3\"/></texture>"));
  EXPECT_EQ(old.height.scale, 3);
  EXPECT_EQ(old.nested, 0);
}

TEST(MitsubaWrappers, NormalMapTakesANamedOrUnnamedTexture) {
  for (const char* name : {"", "name=\"normalmap\""}) {
    const auto map =
        Content(Dialect::current)
            .material<NormalMapMaterial>(with_type(
                "normalmap", fmt::format("<texture type=\"checkerboard\" {}/>{}", name, kGrey)));
    EXPECT_FALSE(map.normals.constant());
  }
}

TEST(MitsubaWrappers, WrongNumbersOfPartsAreErrors) {
  for (const std::string& body :
       {with_type("twosided"), with_type("twosided", kGrey + kGrey + kGrey), with_type("mask"),
        with_type("blendbsdf", kGrey), with_type("bumpmap", kGrey), with_type("bumpmap", kHeight),
        with_type("normalmap", kGrey + kHeight + kHeight)})
    EXPECT_NE(Content(Dialect::current).error_of(body).find("it takes"), std::string::npos) << body;
}

TEST(MitsubaWrappers, MoreLobesThanABsdfHoldsAreAnError) {
  const std::string two = with_type("blendbsdf", kGrey + kGrey);
  const std::string four = with_type("blendbsdf", two + two);
  EXPECT_EQ(Content(Dialect::current).error_of(four), "no error");
  const std::string five = with_type("blendbsdf", four + kGrey);
  EXPECT_NE(Content(Dialect::current).error_of(five).find("more than 4"), std::string::npos);
}

TEST(MitsubaWrappers, DeepNestingIsAnErrorAndNotACrash) {
  std::string body = kGrey;
  for (int i = 0; i < 11; ++i) body = with_type("twosided", body);
  EXPECT_EQ(Content(Dialect::current).error_of(body), "no error");
  for (int i = 0; i < 20; ++i) body = with_type("twosided", body);
  EXPECT_NE(Content(Dialect::current).error_of(body).find("unnest"), std::string::npos);
}

TEST(MitsubaWrappers, ACircleOfReferencesIsAnError) {
  EXPECT_NE(Content(Dialect::current)
                .error_of("<bsdf type=\"twosided\" id=\"a\"><ref id=\"a\"/></bsdf>")
                .find("contains itself"),
            std::string::npos);
}

}  // namespace
}  // namespace waylight::mitsuba
