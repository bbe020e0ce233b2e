#include "formats/mitsuba/scene_texts.h"
#include "libguide/scene/camera.h"

namespace waylight {
namespace {

using testing::mentions;

class SensorTest : public testing::MitsubaScenes {
 protected:
  SensorDescription sensor(const std::string& children, const std::string& type = "perspective",
                           const std::string& version = "3.0.0") {
    return import("<sensor type=\"" + type + "\">" + children + "</sensor>", version).sensor;
  }
  std::string sensor_error(const std::string& children, const std::string& type = "perspective") {
    return import_error("<sensor type=\"" + type + "\">\n" + children + "</sensor>");
  }
  float fov(const std::string& axis, int width, int height) {
    return degrees_x(
        sensor(fmt::format("<float name=\"fov\" value=\"60\"/><string name=\"fov_axis\" "
                           "value=\"{}\"/><film type=\"hdrfilm\"><integer name=\"width\" "
                           "value=\"{}\"/><integer name=\"height\" value=\"{}\"/></film>",
                           axis, width, height)));
  }
  float degrees_x(const SensorDescription& s) { return 360 / kPi * std::atan(tan_half_fov_x(s)); }
  FilmDescription film(const std::string& children, const std::string& version = "3.0.0") {
    return sensor("<film type=\"hdrfilm\">" + children + "</film>", "perspective", version).film;
  }
};

TEST_F(SensorTest, FieldOfViewRefersToItsAxis) {
  EXPECT_NEAR(fov("x", 200, 100), 60, 1e-4);
  EXPECT_NEAR(fov("y", 200, 100), 98.2132f, 1e-3);
  EXPECT_NEAR(fov("smaller", 200, 100), 98.2132f, 1e-3);
  EXPECT_NEAR(fov("larger", 200, 100), 60, 1e-4);
  EXPECT_NEAR(fov("smaller", 100, 200), 60, 1e-4);
  EXPECT_NEAR(fov("larger", 100, 200), 32.2042f, 1e-3);
  EXPECT_NEAR(fov("diagonal", 400, 300), 49.5826f, 1e-3);
}

TEST_F(SensorTest, FocalLengthRefersToTheDiagonalOf35mmFilm) {
  // The diagonal of a 3:2 picture at 50 mm spans 46.79 degrees, its width 39.6.
  const std::string film = R"(<film type="hdrfilm"><integer name="width" value="300"/>
    <integer name="height" value="200"/></film>)";
  EXPECT_NEAR(degrees_x(sensor(film)), 39.5978f, 1e-3);
  EXPECT_NEAR(degrees_x(sensor(film + "<string name=\"focal_length\" value=\"50mm\"/>")), 39.5978f,
              1e-3);
  EXPECT_NEAR(degrees_x(sensor(film + "<float name=\"focal_length\" value=\"18\"/>")), 90, 1e-3);
}

TEST_F(SensorTest, FieldOfViewKeepsItsAxisInAFilmOfAnotherShape) {
  SensorDescription s = sensor(
      "<float name=\"fov\" value=\"60\"/>"
      "<string name=\"fov_axis\" value=\"y\"/>");
  s.film.width = 200, s.film.height = 100;
  EXPECT_NEAR(degrees_x(s), 98.2132f, 1e-3);
}

TEST_F(SensorTest, LensAndPrincipalPointAreRead) {
  const SensorDescription lens = sensor(R"(<float name="fov" value="40"/>
    <float name="apertureRadius" value="0.2"/><float name="focusDistance" value="3"/>
    <float name="nearClip" value="1"/><sampler type="ldsampler"/>)",
                                        "thinlens", "0.5.0");
  EXPECT_EQ(lens.aperture_radius, 0.2f);
  EXPECT_EQ(lens.focus_distance, 3);
  const SensorDescription shifted = sensor(R"(<float name="principal_point_offset_x" value="0.1"/>
    <float name="principal_point_offset_y" value="-0.2"/>)");
  EXPECT_EQ(shifted.principal_x, 0.1f);
  EXPECT_EQ(shifted.principal_y, -0.2f);
  EXPECT_EQ(shifted.aperture_radius, 0);
}

TEST_F(SensorTest, UniformScaleIsTakenOutWithAWarning) {
  const SensorDescription scaled =
      sensor("<transform name=\"to_world\"><scale value=\"3\"/><translate x=\"1\"/></transform>");
  const Mat4 expected = Eigen::Affine3f(Eigen::Translation3f(1, 0, 0)).matrix();
  EXPECT_TRUE(scaled.to_world.isApprox(expected));
  EXPECT_TRUE(mentions(warnings_.at(0), "scale"));
}

TEST_F(SensorTest, FilmCropAndFilters) {
  const FilmDescription cropped = film(R"(<integer name="width" value="20"/>
    <integer name="height" value="10"/><integer name="cropOffsetX" value="5"/>
    <integer name="cropOffsetY" value="2"/><integer name="cropWidth" value="10"/>
    <integer name="cropHeight" value="4"/><boolean name="banner" value="false"/>
    <rfilter type="mitchell"><float name="B" value="0.2"/><float name="C" value="0.4"/></rfilter>)",
                                       "0.6.0");
  EXPECT_EQ(cropped.width, 20);
  EXPECT_EQ(cropped.crop_x, 5);
  EXPECT_EQ(cropped.crop_y, 2);
  EXPECT_EQ(cropped.crop_width, 10);
  EXPECT_EQ(cropped.crop_height, 4);
  EXPECT_EQ(cropped.filter, FilterType::mitchell);
  EXPECT_EQ(cropped.filter_b, 0.2f);
  EXPECT_EQ(cropped.filter_c, 0.4f);
  EXPECT_EQ(film("").crop_width, 0);
  EXPECT_EQ(film("<rfilter type=\"box\"/>").filter, FilterType::box);
  EXPECT_EQ(film("<rfilter type=\"tent\"/>").filter, FilterType::tent);
  EXPECT_EQ(film("").filter, FilterType::gaussian);
}

TEST_F(SensorTest, GaussianFiltersEndAtFourDeviationsUnlessTheySayWhere) {
  const auto radius = [&](const std::string& children) {
    return film("<rfilter type=\"gaussian\">" + children + "</rfilter>").filter_radius;
  };
  EXPECT_EQ(radius(""), 2);
  EXPECT_EQ(radius("<float name=\"stddev\" value=\"1.5\"/>"), 6);
  EXPECT_EQ(radius(R"(<float name="stddev" value="1.5"/><float name="radius" value="3"/>)"), 3);
}

TEST_F(SensorTest, MitchellTakesBAndCOfBothDialectsOrTheNewOnesManualsAAndB) {
  const auto mitchell = [&](const std::string& children, const std::string& version) {
    const FilmDescription f =
        film("<rfilter type=\"mitchell\">" + children + "</rfilter>", version);
    return Vec2(f.filter_b, f.filter_c);
  };
  const std::string b = R"(<float name="B" value="0.2"/>)", c = R"(<float name="C" value="0.4"/>)";
  for (const char* version : {"0.6.0", "3.0.0"}) {
    EXPECT_EQ(mitchell(b + c, version), Vec2(0.2f, 0.4f)) << version;
    EXPECT_EQ(mitchell(b, version), Vec2(0.2f, 1.0f / 3)) << version;
  }
  const std::string a = R"(<float name="A" value="0.1"/>)";
  EXPECT_EQ(mitchell(a + b, "3.0.0"), Vec2(0.1f, 0.2f));
  EXPECT_THROW(mitchell(a + b + c, "3.0.0"), Error);
}

TEST_F(SensorTest, FilterThatIsNotImplementedIsReplacedOnlyWhenAsked) {
  const std::string body = "<film type=\"hdrfilm\"><rfilter type=\"lanczos\"/></film>";
  EXPECT_TRUE(mentions(sensor_error(body), "--lenient"));
  options_.lenient = true;
  EXPECT_EQ(sensor(body).film.filter, FilterType::mitchell);
  EXPECT_TRUE(mentions(warnings_.at(0), "mitchell"));
}

TEST_F(SensorTest, WrongValuesNameTheElement) {
  const std::pair<const char*, const char*> cases[] = {
      {"<float name=\"fov\" value=\"180\"/>", "fov"},
      {"<float name=\"fovv\" value=\"1\"/>", "did you mean \"fov\""},
      {"<string name=\"fov_axis\" value=\"z\"/><float name=\"fov\" value=\"9\"/>",
       "unknown fov_axis \"z\"; known are diagonal, larger, smaller, x, y"},
      {"<float name=\"fov\" value=\"9\"/><float name=\"focal_length\" value=\"9\"/>", "both"},
      {"<film type=\"hdrfilm\"><integer name=\"width\" value=\"0\"/></film>", "width is 0"},
      {"<film type=\"hdrfilm\"><integer name=\"width\" value=\"99999999\"/></film>", "width"},
      {"<film type=\"hdrfilm\"><integer name=\"crop_offset_x\" value=\"900\"/></film>", "crop"},
      {"<film type=\"hdrfim\"/>", "did you mean \"hdrfilm\""},
      {"<film type=\"hdrfilm\"><rfilter type=\"bx\"/></film>", "did you mean \"box\""},
      {R"(<film type="hdrfilm"><rfilter type="gaussian"><float name="stddev" value="5"/></rfilter>
       </film>)",
       "20 pixels far"},
      {"<transform name=\"to_world\"><scale x=\"2\"/></transform>", "rotation"},
      {"<transform name=\"to_world\"><scale value=\"0\"/></transform>", "rotation"}};
  for (const auto& [body, message] : cases) {
    const std::string error = sensor_error(body);
    EXPECT_TRUE(mentions(error, message)) << error;
    EXPECT_TRUE(mentions(error, "scene.xml\":")) << error;
  }
  EXPECT_TRUE(mentions(sensor_error("", "perspektive"), "did you mean \"perspective\""));
  EXPECT_TRUE(mentions(sensor_error("", "thinlens"), "aperture_radius"));
}

TEST_F(SensorTest, IntegratorGivesDefaults) {
  const IntegratorDefaults path = import(R"(<integrator type="path">
    <integer name="maxDepth" value="7"/><integer name="rrDepth" value="3"/>
    <boolean name="hideEmitters" value="true"/><boolean name="strictNormals" value="true"/>
    </integrator>)",
                                         "0.6.0")
                                      .integrator;
  EXPECT_EQ(path.max_depth, 7);
  EXPECT_EQ(path.rr_depth, 3);
  EXPECT_TRUE(path.hide_emitters);
  EXPECT_EQ(import("<integrator type=\"direct\"/>").integrator.max_depth, 2);
  EXPECT_EQ(import(R"(<integrator type="moment"><integrator type="volpath">
    <integer name="max_depth" value="16"/></integrator></integrator>)")
                .integrator.max_depth,
            16);
}

TEST_F(SensorTest, OtherIntegratorsAreAcceptedWithAWarning) {
  const SceneDescription scene = import(R"(<integrator type="guidedpath">
    <integer name="max_depth" value="9"/><integer name="anything" value="3"/></integrator>)");
  EXPECT_EQ(scene.integrator.max_depth, 9);
  EXPECT_TRUE(mentions(warnings_.at(0), "guidedpath"));
  EXPECT_FALSE(mentions(warnings_.at(0), "did you mean"));
  warnings_.clear();
  import("<integrator type=\"pat\"/>");
  EXPECT_TRUE(mentions(warnings_.at(0), "did you mean \"path\"?"));
  EXPECT_TRUE(
      mentions(import_error("<integrator type=\"path\"/><integrator type=\"path\"/>"), "already"));
  EXPECT_TRUE(mentions(import_error(R"(<integrator type="path">
    <integer name="max_dept" value="3"/></integrator>)"),
                       "did you mean \"max_depth\""));
}

TEST_F(SensorTest, ASecondFilmFilterMediumOrIntegratorIsAnError) {
  const std::string medium = "<medium type=\"homogeneous\"/>", film = "<film type=\"hdrfilm\"/>",
                    filter = "<rfilter type=\"box\"/>", path = "<integrator type=\"path\"/>";
  EXPECT_TRUE(mentions(sensor_error(film + film), "has 2 <film>, one is possible"));
  EXPECT_TRUE(mentions(sensor_error(medium + medium), "has 2 <medium>"));
  EXPECT_TRUE(mentions(sensor_error("<film type=\"hdrfilm\">" + filter + filter + "</film>"),
                       "has 2 <rfilter>"));
  EXPECT_TRUE(mentions(import_error("<integrator type=\"aov\">" + path + path + "</integrator>"),
                       "has 2 <integrator>"));
}

TEST_F(SensorTest, PropertiesOfWrappersOfIntegratorsAreChecked) {
  const std::string body = R"(<integrator type="aov"><string name="{}" value="d:depth"/>
                              <integrator type="path"/></integrator>)";
  EXPECT_EQ(import_error(fmt::format(fmt::runtime(body), "aovs")), "no error");
  EXPECT_TRUE(mentions(import_error(fmt::format(fmt::runtime(body), "aovz")), "did you mean"));
}

TEST_F(SensorTest, TheFirstOfSeveralSensorsIsUsed) {
  const SceneDescription scene = import(R"(
    <sensor type="perspective"><float name="fov" value="90"/></sensor>
    <sensor type="perspective"><float name="fov" value="20"/></sensor>)");
  EXPECT_NEAR(scene.sensor.fov, kPi / 2, 1e-5f);
  EXPECT_TRUE(mentions(warnings_.at(0), "left out"));
}

TEST_F(SensorTest, WhatCannotStandAtTheTopIsAnError) {
  EXPECT_TRUE(mentions(import_error("<float name=\"x\" value=\"1\"/>"), "top of a scene"));
  EXPECT_TRUE(mentions(import_error("<bsdf type=\"diffuse\"/>"), "needs an id"));
}

struct Unreferenced {
  const char* element;
  const char* says;
};

TEST_F(SensorTest, MistakesInWhatNothingRefersToAreErrors) {
  const Unreferenced cases[] = {
      {R"(<bsdf type="difuse" id="z"/>)", "did you mean \"diffuse\""},
      {R"(<bsdf type="diffuse" id="z"><float name="reflectanse" value="1"/></bsdf>)",
       "did you mean \"reflectance\""},
      {R"(<texture type="bitmep" id="z"/>)", "did you mean \"bitmap\""},
      {R"(<texture type="bitmap" id="z"><string name="filename" value="no.png"/></texture>)",
       "there is no file"},
      {R"(<medium type="homogenous" id="z"/>)", "did you mean \"homogeneous\""},
      {R"(<volume type="constvolum" id="z"/>)", "did you mean \"constvolume\""},
      {R"(<phase type="gh" id="z"/>)", "did you mean \"hg\""},
      {R"(<film type="hdrfim" id="z"/>)", "did you mean \"hdrfilm\""}};
  for (const auto& [element, says] : cases) {
    const std::string error = import_error(std::string("\n") + element);
    EXPECT_TRUE(mentions(error, says) && mentions(error, "scene.xml\":3: <")) << error;
  }
}

TEST_F(SensorTest, WhatNothingRefersToLeavesTheSceneAsItIs) {
  const std::string cube =
      R"(<bsdf type="diffuse" id="a"/><shape type="cube"><ref id="a"/></shape>)";
  const SceneDescription with = import(cube + R"(<bsdf type="conductor" id="b"/>
      <bsdf type="twosided" id="c"><ref id="a"/></bsdf><medium type="homogeneous" id="m"/>)");
  EXPECT_EQ(with.materials.size(), 1u);
  EXPECT_TRUE(with.media.empty());
  EXPECT_TRUE(with.hash == import(cube).hash);
}

TEST_F(SensorTest, LenientReplacesUnknownMaterialsThatNothingRefersTo) {
  options_.lenient = true;
  EXPECT_TRUE(import(R"(<bsdf type="principled" id="z"/>)").materials.empty());
  EXPECT_TRUE(mentions(warnings_.at(1), "taken as grey")) << warnings_.at(1);  // 0: no sensor
}

TEST_F(SensorTest, UnusedDefineIsAWarning) {
  options_.defines = {{"spp", "3"}};
  import("");
  EXPECT_TRUE(mentions(warnings_.at(0), "-D spp"));
}

}  // namespace
}  // namespace waylight
