#include "formats/mitsuba/content_fixture.h"
#include "formats/mitsuba/materials.h"
#include "libguide/bsdf/fresnel.h"

namespace waylight::mitsuba {
namespace {

Color mean(const Texture& texture) { return texture.mean(); }
float value(const Texture& texture) { return texture.mean().x(); }

TEST(MitsubaMaterials, DefaultsOfDiffusePhongAndWardAreTheSameInBothDialects) {
  for (const Dialect dialect : kBoth) {
    EXPECT_EQ(value(Content(dialect).material<DiffuseMaterial>(with_type("diffuse")).reflectance),
              0.5f);
    const PhongMaterial phong = Content(dialect).material<PhongMaterial>(with_type("phong"));
    EXPECT_EQ(value(phong.exponent), 30);
    EXPECT_EQ(value(phong.specular_reflectance), 0.2f);
    EXPECT_EQ(value(phong.diffuse_reflectance), 0.5f);
    const WardMaterial ward = Content(dialect).material<WardMaterial>(with_type("ward"));
    EXPECT_EQ(ward.variant, WardMaterial::Variant::balanced);
    EXPECT_EQ(value(ward.alpha_u), 0.1f);
    EXPECT_EQ(value(ward.alpha_v), 0.1f);
  }
}

TEST(MitsubaMaterials, ParametersHaveTheSpellingOfTheirDialect) {
  const PhongMaterial old =
      Content(Dialect::old)
          .material<PhongMaterial>(with_type("phong",
                                             "<float name=\"exponent\" value=\"7\"/><rgb "
                                             "name=\"diffuseReflectance\" value=\".1 .2 .3\"/>"));
  EXPECT_EQ(value(old.exponent), 7);
  expect_color(mean(old.diffuse_reflectance), {0.1f, 0.2f, 0.3f});
  const WardMaterial ward =
      Content(Dialect::current)
          .material<WardMaterial>(with_type("ward",
                                            "<float name=\"alpha_u\" value=\".3\"/>"
                                            "<string name=\"variant\" value=\"ward-duer\"/>"));
  EXPECT_EQ(value(ward.alpha_u), 0.3f);
  EXPECT_EQ(value(ward.alpha_v), 0.1f);
  EXPECT_EQ(ward.variant, WardMaterial::Variant::ward_duer);
}

TEST(MitsubaMaterials, AConductorIsCopperInTheOldDialectAndAPerfectMirrorInTheNew) {
  const auto old = Content(Dialect::old).material<ConductorMaterial>(with_type("conductor"));
  expect_color(old.eta, metal_preset("Cu")->eta / 1.000277f);
  expect_color(old.k, metal_preset("Cu")->k / 1.000277f);
  const auto current =
      Content(Dialect::current).material<ConductorMaterial>(with_type("conductor"));
  expect_color(fresnel_conductor(0.3f, current.eta, current.k), Color::Ones());
}

TEST(MitsubaMaterials, RoughConductorTakesPresetsMeasuredIndicesAndBothDistributions) {
  const auto gold = Content(Dialect::current)
                        .material<RoughConductorMaterial>(with_type(
                            "roughconductor", "<string name=\"material\" value=\"Au\"/>"));
  EXPECT_EQ(gold.distribution, MicrofacetDistribution::beckmann);
  EXPECT_EQ(value(gold.alpha_u), 0.1f);
  expect_color(gold.k, metal_preset("Au")->k);
  const auto lamp = Content(Dialect::old)
                        .material<RoughConductorMaterial>(
                            with_type("roughconductor",
                                      "<string name=\"distribution\" value=\"ggx\"/>"
                                      "<float name=\"extEta\" value=\"2\"/>"
                                      "<float name=\"alphaU\" value=\".2\"/>"
                                      "<float name=\"alphaV\" value=\".4\"/>"
                                      "<boolean name=\"sampleVisible\" value=\"false\"/>"
                                      "<rgb name=\"eta\" value=\"2 4 6\"/>"
                                      "<rgb name=\"k\" value=\"4 4 2\"/>"));
  EXPECT_EQ(lamp.distribution, MicrofacetDistribution::ggx);
  EXPECT_EQ(value(lamp.alpha_u), 0.2f);
  EXPECT_EQ(value(lamp.alpha_v), 0.4f);
  expect_color(lamp.eta, {1, 2, 3});
  expect_color(lamp.k, {2, 2, 1});
}

TEST(MitsubaMaterials, MetalPresetsHaveTheirColours) {
  const auto reflectance = [](const char* name) {
    return fresnel_conductor(1, metal_preset(name)->eta, metal_preset(name)->k);
  };
  for (const std::string& name : known_metals()) {
    const Color r = reflectance(name.c_str());
    EXPECT_TRUE(r.minCoeff() > 0.15f && r.maxCoeff() <= 1) << name;
  }
  EXPECT_GT(reflectance("Au").x(), reflectance("Au").z() + 0.3f);
  EXPECT_GT(reflectance("Cu").x(), reflectance("Cu").y() + 0.2f);
  EXPECT_GT(reflectance("Ag").minCoeff(), 0.9f);
  EXPECT_NEAR(reflectance("Al").mean(), 0.92f, 0.02f);
}

TEST(MitsubaMaterials, DielectricsAreGlassInAirUnlessSaidOtherwise) {
  for (const Dialect dialect : kBoth) {
    EXPECT_NEAR(Content(dialect).material<DielectricMaterial>(with_type("dielectric")).eta,
                1.5046f / 1.000277f, 1e-6f);
    EXPECT_NEAR(Content(dialect).material<ThinDielectricMaterial>(with_type("thindielectric")).eta,
                1.5046f / 1.000277f, 1e-6f);
    const auto rough =
        Content(dialect).material<RoughDielectricMaterial>(with_type("roughdielectric"));
    EXPECT_NEAR(rough.eta, 1.5046f / 1.000277f, 1e-6f);
    EXPECT_EQ(value(rough.alpha_v), 0.1f);
  }
}

TEST(MitsubaMaterials, IndicesOfRefractionAreNumbersOrNames) {
  const auto water = Content(Dialect::current)
                         .material<ThinDielectricMaterial>(
                             with_type("thindielectric",
                                       "<string name=\"int_ior\" value=\"Water\"/>"
                                       "<string name=\"ext_ior\" value=\"vacuum\"/>"));
  EXPECT_FLOAT_EQ(water.eta, 1.333f);
  const auto glass =
      Content(Dialect::old)
          .material<DielectricMaterial>(with_type("dielectric",
                                                  "<float name=\"intIOR\" value=\"1.5\"/>"
                                                  "<float name=\"extIOR\" value=\"1\"/>"
                                                  "<rgb name=\"specularTransmittance\" "
                                                  "value=\" 0.1 0.5 0.7 \"/>"));
  EXPECT_FLOAT_EQ(glass.eta, 1.5f);
  expect_color(mean(glass.specular_transmittance), {0.1f, 0.5f, 0.7f});
}

TEST(MitsubaMaterials, PlasticsAreOfPolypropylene) {
  for (const Dialect dialect : kBoth) {
    const auto plastic = Content(dialect).material<PlasticMaterial>(with_type("plastic"));
    EXPECT_NEAR(plastic.eta, 1.49f / 1.000277f, 1e-6f);
    EXPECT_FALSE(plastic.nonlinear);
    const auto rough = Content(dialect).material<RoughPlasticMaterial>(
        with_type("roughplastic",
                  "<boolean name=\"nonlinear\" value=\"true\"/>"
                  "<float name=\"alpha\" value=\".15\"/>"));
    EXPECT_TRUE(rough.nonlinear);
    EXPECT_EQ(value(rough.alpha), 0.15f);
    EXPECT_EQ(value(rough.diffuse_reflectance), 0.5f);
    EXPECT_EQ(value(rough.specular_reflectance), 1);
  }
}

TEST(MitsubaMaterials, OneElementIsImportedOnceHoweverOftenItIsReferredTo) {
  Content content(Dialect::current);
  content.import(
      "<bsdf type=\"diffuse\" id=\"grey\"/>"
      "<bsdf type=\"twosided\"><ref id=\"grey\"/></bsdf>"
      "<bsdf type=\"twosided\"><ref id=\"grey\"/></bsdf>");
  ASSERT_EQ(content.scene.materials.size(), 3u);
  EXPECT_EQ(content.scene.materials[0].name, "grey");
  EXPECT_EQ(content.scene.materials[1].name, "twosided@line 2");
  EXPECT_EQ(std::get<TwoSidedMaterial>(content.scene.materials[2].model).front, 0);
}

TEST(MitsubaMaterials, UnknownTypesNameFileLineAndTheNearestKnownName) {
  const std::string error =
      Content(Dialect::old).error_of(fmt::format("\n{}", with_type("rougconductor")));
  EXPECT_NE(error.find("scene.xml\":3: <bsdf type=\"rougconductor\">"), std::string::npos) << error;
  EXPECT_NE(error.find("did you mean \"roughconductor\"?"), std::string::npos) << error;
  EXPECT_NE(Content(Dialect::old).error_of(with_type("difftrans")), "no error");
}

TEST(MitsubaMaterials, LenientTakesUnknownTypesAsGreyAndWarns) {
  Content content(Dialect::current, true);
  const DiffuseMaterial grey = content.material<DiffuseMaterial>(
      with_type("principled", "<float name=\"metallic\" value=\"1\"/>"));
  EXPECT_EQ(value(grey.reflectance), 0.5f);
  ASSERT_EQ(content.warnings.size(), 1u);
  EXPECT_NE(content.warnings[0].find("principled"), std::string::npos);
}

TEST(MitsubaMaterials, PhongMicrofacetsAreRefusedOrLenientlyTakenAsBeckmann) {
  const std::string body =
      with_type("roughconductor", "<string name=\"distribution\" value=\"phong\"/>");
  EXPECT_NE(Content(Dialect::old).error_of(body).find("beckmann"), std::string::npos);
  Content lenient(Dialect::old, true);
  EXPECT_EQ(lenient.material<RoughConductorMaterial>(body).distribution,
            MicrofacetDistribution::beckmann);
  EXPECT_EQ(lenient.warnings.size(), 1u);
}

TEST(MitsubaMaterials, AlphaOfASmoothMaterialIsAWarningInTheOldDialectAndAnErrorInTheNew) {
  const std::string body = with_type("dielectric", "<float name=\"alpha\" value=\".1\"/>");
  Content old(Dialect::old);
  old.import(body);
  EXPECT_EQ(old.warnings.size(), 1u);
  EXPECT_NE(Content(Dialect::current).error_of(body), "no error");
}

struct Bad {
  const char* type;
  const char* body;
  const char* says;
};

TEST(MitsubaMaterials, WrongParametersAreNamed) {
  const Bad cases[] = {
      {"diffuse", "<rgb name=\"reflectence\" value=\"1\"/>", "did you mean \"reflectance\"?"},
      {"diffuse", "<string name=\"reflectance\" value=\"red\"/>", "is no colour"},
      {"principled", "", "known are blendbsdf, bumpmap, conductor"},
      {"conductor", "<string name=\"material\" value=\"Ay\"/>", "unknown metal"},
      {"conductor", "<string name=\"material\" value=\"Aluminum\"/>", "known are Ag, Al, Au"},
      {"diffuse", "<rgb name=\"reflectance\" value=\".5 -.1 .5\"/>", "reflectance is negative"},
      {"dielectric", "<float name=\"specular_transmittance\" value=\"-1\"/>",
       "specular_transmittance is negative"},
      {"conductor", "<texture type=\"checkerboard\" name=\"eta\"/>",
       "is a <texture>, which is not supported"},
      {"conductor", "<rgb name=\"eta\" value=\"-1\"/>", "negative"},
      {"conductor", "<string name=\"material\" value=\"Au\"/><rgb name=\"eta\" value=\"1\"/>",
       "one or the other"},
      {"roughconductor", "<float name=\"alpha\" value=\"-1\"/>", "alpha is negative"},
      {"roughconductor",
       "<float name=\"alpha\" value=\".1\"/><float name=\"alpha_u\" value=\".1\"/>",
       "one or the other"},
      {"roughconductor", "<string name=\"distribution\" value=\"gxx\"/>", "did you mean \"ggx\"?"},
      {"dielectric", "<float name=\"int_ior\" value=\"0\"/>", "must be above 0"},
      {"dielectric", "<string name=\"int_ior\" value=\"watr\"/>", "did you mean \"water\"?"},
      {"plastic", "<float name=\"int_ior\" value=\"0.9\"/>", "coat is denser"},
      {"roughplastic", "<float name=\"alpha_u\" value=\".1\"/>", "isotropic"},
      {"phong", "<float name=\"exponent\" value=\"-3\"/>", "exponent is negative"},
      {"ward", "<string name=\"variant\" value=\"balansed\"/>", "did you mean \"balanced\"?"}};
  for (const Bad& bad : cases) {
    const std::string error = Content(Dialect::current).error_of(with_type(bad.type, bad.body));
    EXPECT_NE(error.find(bad.says), std::string::npos) << bad.type << bad.body << ": " << error;
    EXPECT_NE(error.find("scene.xml\":"), std::string::npos) << error;
  }
}

TEST(MitsubaMaterials, AReflectanceAboveOneIsWarnedOf) {
  const auto warnings = [](const std::string& type, const std::string& body) {
    Content content(Dialect::current);
    content.import(with_type(type, body));
    return content.warnings;
  };
  const std::vector<std::string> bright =
      warnings("diffuse", "<rgb name=\"diffuse_reflectance\" value=\"1 1.5 1\"/>");
  ASSERT_EQ(bright.size(), 1u);
  EXPECT_NE(bright[0].find("its diffuse_reflectance is above 1"), std::string::npos) << bright[0];
  EXPECT_EQ(warnings("dielectric", "<float name=\"specular_transmittance\" value=\"2\"/>").size(),
            1u);
  EXPECT_TRUE(warnings("diffuse", "<float name=\"reflectance\" value=\"1\"/>").empty());
}

}  // namespace
}  // namespace waylight::mitsuba
