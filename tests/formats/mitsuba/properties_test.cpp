#include <clocale>

#include "formats/mitsuba/scene_texts.h"

namespace waylight {
namespace {

using mitsuba::Properties;
using testing::error_of;
using testing::mentions;

class PropertiesTest : public testing::MitsubaScenes {
 protected:
  // Properties of one element with the given children; the document lives as long as the test.
  Properties with(const std::string& children) {
    document_ = parse("<bsdf type=\"test\">" + children + "</bsdf>");
    return Properties(document_, document_.root.children[0]);
  }
  Color color(const std::string& child) {
    Properties properties = with(child);
    return properties.color("c", Color::Zero());
  }
  Mat4 transform(const std::string& steps) {
    Properties properties = with("<transform name=\"t\">" + steps + "</transform>");
    return properties.transform("t");
  }
  Vec3 apply(const std::string& steps, const Vec3& p) {
    return (transform(steps) * p.homogeneous()).head<3>();
  }

 private:
  mitsuba::Document document_;
};

void expect_near(const Color& value, const Color& expected, float tolerance = 1e-6f) {
  EXPECT_LT((value - expected).abs().maxCoeff(), tolerance) << value.transpose();
}
void expect_near(const Vec3& value, const Vec3& expected) {
  EXPECT_LT((value - expected).norm(), 1e-5f) << value.transpose();
}

TEST_F(PropertiesTest, ValuesAreRead) {
  Properties properties = with(R"(<float name="f" value=" -1.5e2 "/><integer name="i" value="+7"/>
    <boolean name="b" value="true"/><string name="s" value="a b"/>
    <vector name="v" x="1" z="3"/><point name="p" value="1, 2 3"/>)");
  EXPECT_EQ(properties.number("f", 0), -150);
  EXPECT_EQ(properties.integer("i", 0), 7);
  EXPECT_EQ(properties.number("i", 0), 7);
  EXPECT_TRUE(properties.boolean("b", false));
  EXPECT_EQ(properties.text("s", ""), "a b");
  EXPECT_EQ(properties.vector("v", Vec3::Ones()), Vec3(1, 0, 3));
  EXPECT_EQ(properties.vector("p", Vec3::Ones()), Vec3(1, 2, 3));
  EXPECT_EQ(properties.number("absent", 4), 4);
  properties.finish();
}

TEST_F(PropertiesTest, NumbersDoNotDependOnTheLocale) {
  const char* changed = std::setlocale(LC_ALL, "de_DE.UTF-8");
  Properties properties = with("<float name=\"f\" value=\"1.5\"/>");
  EXPECT_EQ(properties.number("f", 0), 1.5f);
  if (changed) std::setlocale(LC_ALL, "C");
}

TEST_F(PropertiesTest, WrongValuesAreErrors) {
  for (const char* value :
       {"", "nan", "inf", "1e39", "1e999", "1,5", "0x10", "--1", "+-1", "1 2"}) {
    Properties properties = with(fmt::format("\n<float name=\"f\" value=\"{}\"/>", value));
    const std::string error = error_of([&] { properties.number("f", 0); });
    EXPECT_TRUE(mentions(error, "scene.xml\":3: <float name=\"f\">")) << error;
  }
  Properties properties = with(R"(<integer name="i" value="99999999999"/>
    <boolean name="b" value="maybe"/><string name="s" value="x"/><float name="n"/>)");
  EXPECT_TRUE(mentions(error_of([&] { properties.integer("i", 0); }), "is no integer"));
  EXPECT_TRUE(mentions(error_of([&] { properties.boolean("b", false); }), "neither"));
  EXPECT_TRUE(mentions(error_of([&] { properties.number("s", 0); }), "should be a <float>"));
  EXPECT_TRUE(mentions(error_of([&] { properties.number("n", 0); }), "needs \"value\""));
}

TEST_F(PropertiesTest, UnknownPropertySuggestsTheNearestName) {
  Properties properties = with("<float name=\"alhpa\" value=\"1\"/>");
  properties.number("alpha", 0);
  const std::string error = error_of([&] { properties.finish(); });
  EXPECT_TRUE(mentions(error, "<float name=\"alhpa\">")) << error;
  EXPECT_TRUE(mentions(error, "did you mean \"alpha\"?")) << error;
}

TEST_F(PropertiesTest, NestedObjectsNobodyAskedForAreErrors) {
  Properties properties = with("<texture type=\"bitmap\"/>");
  EXPECT_TRUE(mentions(error_of([&] { properties.finish(); }), "has no place in"));
  EXPECT_EQ(properties.objects("texture").size(), 1u);
  properties.finish();
}

TEST_F(PropertiesTest, GivenTwiceIsAnError) {
  Properties properties = with("<float name=\"a\" value=\"1\"/><float name=\"a\" value=\"2\"/>");
  EXPECT_TRUE(mentions(error_of([&] { properties.number("a", 0); }), "already given"));
}

TEST_F(PropertiesTest, ColorsAreLinear) {
  expect_near(color("<rgb name=\"c\" value=\"0.1, 0.2, 0.3\"/>"), {0.1f, 0.2f, 0.3f});
  expect_near(color("<rgb name=\"c\" value=\"  0.1 0.2 0.3 \"/>"), {0.1f, 0.2f, 0.3f});
  expect_near(color("<rgb name=\"c\" value=\"0.5\"/>"), {0.5f, 0.5f, 0.5f});
  expect_near(color("<float name=\"c\" value=\"0.5\"/>"), {0.5f, 0.5f, 0.5f});
  expect_near(color("<spectrum name=\"c\" value=\"0.5\"/>"), {0.5f, 0.5f, 0.5f});
  expect_near(color("<srgb name=\"c\" value=\"0, 0.5, 1\"/>"), {0, 0.2140411f, 1});
  expect_near(color("<rgb name=\"c\" value=\"#0080ff\"/>"), {0, 0.2158605f, 1});
  expect_near(color("<spectrum name=\"c\" type=\"d65\"/>"), {1, 1, 1});
}

TEST_F(PropertiesTest, SpectraMayBeElementsWithPropertiesOfTheirOwn) {
  const auto spectrum = [this](const std::string& type, const std::string& body) {
    return color("<spectrum name=\"c\" type=\"" + type + "\">" + body + "</spectrum>");
  };
  const std::string values = R"(<string name="values" value="0, .5, 1"/>)";
  const Color ramp = color("<spectrum name=\"c\" value=\"400:0, 500:.5, 600:1\"/>");
  expect_near(spectrum("uniform", R"(<float name="value" value=".25"/>)"), {0.25f, 0.25f, 0.25f});
  expect_near(spectrum("d65", R"(<float name="scale" value="3"/>)"), {3, 3, 3});
  expect_near(
      spectrum("d65", R"(<float name="scale" value="2"/><rgb name="color" value="1 2 3"/>)"),
      {2, 4, 6});
  expect_near(
      spectrum("irregular", R"(<string name="wavelengths" value="400, 500, 600"/>)" + values),
      ramp);
  for (const char* name : {"wavelength", "lambda"})
    expect_near(spectrum("regular", fmt::format(R"(<float name="{0}_min" value="400"/>
                                        <float name="{0}_max" value="600"/>)",
                                                name) +
                                        values),
                ramp);
  const Color glow = spectrum("blackbody", R"(<float name="temperature" value="5000"/>)");
  const Color same = color("<blackbody name=\"c\" temperature=\"5000\"/>");
  expect_near(Color(glow / same), Color::Ones());
}

TEST_F(PropertiesTest, WrongSpectraNameWhatIsWrong) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"blackbdy", "", "did you mean \"blackbody\"?"},
      {"rgb_importance", "", "known are blackbody, d65, irregular, regular, uniform"},
      {"blackbody", "", "needs a <float name=\"temperature\">"},
      {"blackbody", R"(<float name="temperature" value="0"/>)", "above 0 K"},
      {"uniform", R"(<float name="valu" value="1"/>)", "did you mean \"value\"?"},
      {"d65", R"(<texture type="checkerboard"/>)", "has no place in"},
      {"regular", R"(<string name="values" value="1 1"/>)", "name=\"wavelength_min\""},
      {"irregular", R"(<string name="wavelengths" value="400 500 600"/>
                       <string name="values" value="1 1"/>)",
       "3 wavelengths and 2 values"}};
  for (const auto& [type, body, says] : cases) {
    const std::string error = error_of(
        [&] { color(fmt::format("<spectrum name=\"c\" type=\"{}\">{}</spectrum>", type, body)); });
    EXPECT_TRUE(mentions(error, says)) << error;
    EXPECT_TRUE(mentions(error, "scene.xml\":2")) << error;
  }
}

TEST_F(PropertiesTest, AttributesThatASpectrumDoesNotReadAreErrors) {
  expect_near(color(R"(<spectrum name="c" type="uniform" value=".5"/>)"), {0.5f, 0.5f, 0.5f});
  expect_near(color(R"(<spectrum name="c" type="d65" scale="5"/>)"), {5, 5, 5});
  for (const char* child :
       {R"(<spectrum name="c" value="1" scale="5"/>)",
        R"(<spectrum name="c" type="uniform" value="1" scale="5"/>)",
        R"(<spectrum name="c" type="d65" value="5"/>)",
        R"(<spectrum name="c" type="blackbody" scale="5"><float name="temperature" value="5000"/>
           </spectrum>)"})
    EXPECT_TRUE(mentions(error_of([&] { color(child); }), "takes no attribute")) << child;
}

TEST_F(PropertiesTest, TheIntentOfAColorIsWithoutEffect) {
  for (const char* intent : {"reflectance", "illuminant"})
    expect_near(color(fmt::format("<rgb name=\"c\" value=\".5\" intent=\"{}\"/>", intent)),
                {0.5f, 0.5f, 0.5f});
  EXPECT_TRUE(
      mentions(error_of([&] { color("<rgb name=\"c\" value=\"1\" intent=\"iluminant\"/>"); }),
               "did you mean \"illuminant\"?"));
}

TEST_F(PropertiesTest, WrongColorsAreErrors) {
  for (const char* child :
       {"<rgb name=\"c\" value=\"1, 2\"/>", "<rgb name=\"c\" value=\"#12345g\"/>",
        "<rgb name=\"c\" value=\"#123\"/>", "<rgb name=\"c\"/>",
        "<boolean name=\"c\" value=\"1\"/>", "<spectrum name=\"c\" value=\"400:1\"/>",
        "<spectrum name=\"c\" value=\"500:1, 400:1\"/>",
        "<spectrum name=\"c\" value=\"400:1, 500\"/>", "<blackbody name=\"c\" temperature=\"0\"/>"})
    EXPECT_TRUE(mentions(error_of([&] { color(child); }), "name=\"c\"")) << child;
}

TEST_F(PropertiesTest, StepsApplyInTheirOrder) {
  const std::string scale = "<scale value=\"2\"/>", move = "<translate x=\"1\"/>";
  expect_near(apply(scale + move, {1, 1, 1}), {3, 2, 2});
  expect_near(apply(move + scale, {1, 1, 1}), {4, 2, 2});
  expect_near(apply("<scale y=\"3\"/><scale value=\"1, 1, 2\"/>", {1, 1, 1}), {1, 3, 2});
  expect_near(apply("<translate value=\"1, 2, 3\"/>", {0, 0, 0}), {1, 2, 3});
}

TEST_F(PropertiesTest, RotationIsRightHandedInDegrees) {
  expect_near(apply("<rotate z=\"1\" angle=\"90\"/>", {1, 0, 0}), {0, 1, 0});
  expect_near(apply("<rotate y=\"5\" angle=\"90\"/>", {1, 0, 0}), {0, 0, -1});
}

TEST_F(PropertiesTest, LookAtHasLeftUpForward) {
  const std::string step = "<lookat origin=\"1,2,3\" target=\"1,2,9\" up=\"0,1,0\"/>";
  expect_near(apply(step, {0, 0, 0}), {1, 2, 3});
  expect_near(apply(step, {1, 0, 0}), {2, 2, 3});
  expect_near(apply(step, {0, 1, 0}), {1, 3, 3});
  expect_near(apply(step, {0, 0, 1}), {1, 2, 4});
}

TEST_F(PropertiesTest, LookAtWithoutUsableUpIsStillARotation) {
  for (const char* up : {"", "up=\"0,0,0\"", "up=\"0,0,5\"", "up=\"0,0,-1\""}) {
    const Mat4 m = transform(fmt::format("<lookat origin=\"0,0,0\" target=\"0,0,2\" {}/>", up));
    const Mat3 rotation = m.topLeftCorner<3, 3>();
    EXPECT_TRUE((rotation.transpose() * rotation).isIdentity(1e-5f)) << up;
    EXPECT_NEAR(rotation.determinant(), 1, 1e-5f);
  }
}

TEST_F(PropertiesTest, MatricesAreRowByRow) {
  expect_near(apply("<matrix value=\"1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1\"/>", {0, 0, 0}),
              {5, 6, 7});
  expect_near(apply("<matrix value=\"0 1 0 0 0 1 1 0 0\"/>", {1, 2, 3}), {2, 3, 1});
}

TEST_F(PropertiesTest, WrongTransformsAreErrors) {
  for (const char* step :
       {"<matrix value=\"1 2 3\"/>", "<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>",
        "<rotate angle=\"3\"/>", "<rotate x=\"1\"/>", "<translate value=\"1 2\"/>",
        "<lookat origin=\"0,0,0\" target=\"0,0,0\"/>", "<lookat origin=\"0,0,0\"/>",
        "<scale value=\"1e30\"/><scale value=\"1e30\"/>"})
    EXPECT_TRUE(mentions(error_of([&] { transform(step); }), "scene.xml\":2")) << step;
}

TEST_F(PropertiesTest, ReferencesAreFollowedByNameAndByTag) {
  const mitsuba::Document document = parse(R"(<texture type="bitmap" id="t"/>
    <bsdf type="x"><ref name="reflectance" id="t"/><rgb name="tint" value="1"/></bsdf>)");
  Properties properties(document, document.root.children[1]);
  EXPECT_EQ(properties.object("reflectance"), &document.root.children[0]);
  EXPECT_EQ(properties.object("tint"), nullptr);
  EXPECT_EQ(properties.tag("tint"), "rgb");
  EXPECT_EQ(properties.objects("texture").size(), 1u);
  properties.finish();
}

}  // namespace
}  // namespace waylight
