#include "formats/image_io.h"
#include "formats/mitsuba/content_fixture.h"

namespace waylight::mitsuba {
namespace {

std::string light(const std::string& type, const std::string& body = "") {
  return fmt::format("<emitter type=\"{}\">{}</emitter>", type, body);
}

// "to_world" in the spelling of a dialect.
std::string to_world(Dialect dialect, const std::string& steps) {
  return fmt::format("<transform name=\"{}\">{}</transform>",
                     dialect == Dialect::old ? "toWorld" : "to_world", steps);
}

void expect_direction(const Vec3& actual, const Vec3& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-5f) << actual.transpose();
}

TEST(MitsubaEmitters, PointLightsStandAtTheirPositionOrTransform) {
  const auto current =
      Content(Dialect::current)
          .emitter<PointLight>(light("point",
                                     "<point name=\"position\" x=\"1\" y=\"2\" z=\"3\"/>"
                                     "<rgb name=\"intensity\" value=\"4 5 6\"/>"));
  EXPECT_EQ(current.position, Vec3(1, 2, 3));
  expect_color(current.intensity, {4, 5, 6});
  const auto old =
      Content(Dialect::old)
          .emitter<PointLight>(light("point", to_world(Dialect::old, "<translate x=\"7\"/>")));
  EXPECT_EQ(old.position, Vec3(7, 0, 0));
  expect_color(old.intensity, Color::Ones());
}

TEST(MitsubaEmitters, PowerOfAPointLightSpreadsOverTheSphere) {
  const auto point =
      Content(Dialect::old)
          .emitter<PointLight>(light("point", "<spectrum name=\"power\" value=\"100\"/>"));
  expect_color(point.intensity, Color::Constant(100 / (4 * kPi)));
}

TEST(MitsubaEmitters, SpotLightsLookAlongZAndFadeFromThreeQuarters) {
  for (const Dialect dialect : kBoth) {
    const auto spot = Content(dialect).emitter<SpotLight>(
        light("spot", to_world(dialect, "<rotate y=\"1\" angle=\"90\"/><translate z=\"2\"/>")));
    EXPECT_EQ(spot.position, Vec3(0, 0, 2));
    expect_direction(spot.direction, Vec3::UnitX());
    EXPECT_NEAR(spot.cutoff, 20 * kPi / 180, 1e-6f);
    EXPECT_NEAR(spot.beam_width, 15 * kPi / 180, 1e-6f);
  }
}

TEST(MitsubaEmitters, DirectionalLightsTravelAlongTheirDirectionOrZ) {
  for (const Dialect dialect : kBoth) {
    const auto given = Content(dialect).emitter<DirectionalLight>(
        light("directional",
              "<vector name=\"direction\" x=\"0\" y=\"-2\" z=\"0\"/>"
              "<rgb name=\"irradiance\" value=\"3\"/>"));
    expect_direction(given.direction, -Vec3::UnitY());
    expect_color(given.irradiance, Color::Constant(3));
    expect_direction(Content(dialect).emitter<DirectionalLight>(light("directional")).direction,
                     Vec3::UnitZ());
  }
}

TEST(MitsubaEmitters, ConstantAndAreaRadianceAreOneByDefault) {
  for (const Dialect dialect : kBoth) {
    expect_color(Content(dialect).emitter<ConstantEnvironment>(light("constant")).radiance,
                 Color::Ones());
    Content content(dialect);
    content.import(light("area") + light("area", "<rgb name=\"radiance\" value=\"17, 12, 4\"/>"));
    expect_color(content.radiances.at(0), Color::Ones());
    expect_color(content.radiances.at(1), {17, 12, 4});
  }
}

TEST(MitsubaEmitters, ScaleOfAnAreaLightIsAWarningInTheOldDialect) {
  const std::string body = light("area", "<float name=\"scale\" value=\"3\"/>");
  Content old(Dialect::old);
  old.import(body);
  expect_color(old.radiances.at(0), Color::Ones());
  EXPECT_EQ(old.warnings.size(), 1u);
  EXPECT_NE(Content(Dialect::current).error_of(body), "no error");
}

void write_sky(const std::string& path) {
  Image image(4, 2, {"R", "G", "B"});
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
  write_exr(path, image);
}

TEST(MitsubaEmitters, EnvironmentMapsAreTurnedAndScaled) {
  for (const Dialect dialect : kBoth) {
    Content content(dialect);
    write_sky(content.file("sky.exr"));
    const auto map = content.emitter<EnvironmentMap>(
        light("envmap",
              "<string name=\"filename\" value=\"sky.exr\"/>"
              "<float name=\"scale\" value=\"2\"/>" +
                  to_world(dialect, "<rotate y=\"1\" angle=\"90\"/>")));
    EXPECT_EQ(map.bitmap->width, 4);
    expect_color(map.bitmap->at(1, 0), {3, 4, 5});
    EXPECT_EQ(map.scale, 2);
    expect_direction(map.to_world * Vec3::UnitZ(), Vec3::UnitX());
  }
}

TEST(MitsubaEmitters, ASkewedEnvironmentIsAnErrorAndAScaledOneIsNot) {
  Content content(Dialect::current);
  write_sky(content.file("sky.exr"));
  const auto body = [](const char* steps) {
    return light("envmap", "<string name=\"filename\" value=\"sky.exr\"/>" +
                               to_world(Dialect::current, steps));
  };
  EXPECT_EQ(content.error_of(body("<scale value=\"5\"/>")), "no error");
  EXPECT_NE(content.error_of(body("<scale x=\"2\"/>")).find("skewed"), std::string::npos);
  EXPECT_NE(content.error_of(body("<scale value=\"0\"/>")).find("flat"), std::string::npos);
}

TEST(MitsubaEmitters, SunAndSkyOfADirectionGiveAMapAndADisk) {
  const std::string direction = "<vector name=\"sunDirection\" x=\"0\" y=\"1\" z=\"1\"/>";
  Content content(Dialect::old);
  content.import(light("sunsky", direction + "<float name=\"sunScale\" value=\"2\"/>"
                                             "<float name=\"skyScale\" value=\"3\"/>"));
  ASSERT_EQ(content.scene.emitters.size(), 2u);
  EXPECT_EQ(std::get<EnvironmentMap>(content.scene.emitters[0]).scale, 3);
  const DistantDisk twice = std::get<DistantDisk>(content.scene.emitters[1]);
  expect_direction(twice.to_light, Vec3(0, 1, 1).normalized());
  const auto once = Content(Dialect::old).emitter<DistantDisk>(light("sun", direction));
  expect_color(twice.radiance / once.radiance, Color::Constant(2));
  EXPECT_EQ(Content(Dialect::old).emitter<EnvironmentMap>(light("sky", direction)).scale, 1);
}

// The direction is in the world: turning the sky leaves the sun where it is.
TEST(MitsubaEmitters, TheSunKeepsItsDirectionWhenTheSkyIsTurned) {
  const auto sun = Content(Dialect::old)
                       .emitter<DistantDisk>(light(
                           "sun", "<vector name=\"sunDirection\" x=\"0\" y=\"1\" z=\"1\"/>" +
                                      to_world(Dialect::old, "<rotate y=\"1\" angle=\"30\"/>")));
  expect_direction(sun.to_light, Vec3(0, 1, 1).normalized());
}

TEST(MitsubaEmitters, UpIsYInTheOldDialectAndZInTheNew) {
  const auto old = Content(Dialect::old).emitter<DistantDisk>(light("sun"));
  const auto current = Content(Dialect::current).emitter<DistantDisk>(light("sun"));
  EXPECT_NEAR(std::asin(old.to_light.y()) * 180 / kPi, 46, 2);  // Tokyo, a summer afternoon
  EXPECT_NEAR(old.to_light.y(), current.to_light.z(), 1e-6f);
  EXPECT_NEAR(old.to_light.x(), current.to_light.x(), 1e-6f);
  EXPECT_LT(old.to_light.x(), 0);  // west
}

TEST(MitsubaEmitters, WrongEmittersAreNamed) {
  struct Bad {
    const char* type;
    const char* body;
    const char* says;
  };
  const Bad cases[] = {
      {"pont", "", "did you mean \"point\"?"},
      {"projector", "", "known are area, constant, directional"},
      {"point", "<rgb name=\"intensity\" value=\"-1\"/>", "intensity is negative"},
      {"point", "<rgb name=\"radiance\" value=\"1\"/>", "no property of that name"},
      {"point",
       "<point name=\"position\" x=\"1\"/><transform name=\"to_world\"><translate x=\"1\"/>"
       "</transform>",
       "one or the other"},
      {"spot", "<float name=\"cutoff_angle\" value=\"0\"/>", "cutoff_angle 0"},
      {"spot", "<float name=\"beam_width\" value=\"30\"/>", "beam_width 30"},
      {"spot", "<texture type=\"checkerboard\" name=\"texture\"/>", "not supported"},
      {"directional", "<vector name=\"direction\" x=\"0\" y=\"0\" z=\"0\"/>", "direction is zero"},
      {"envmap", "", "needs a filename"},
      {"sunsky", "<float name=\"turbidity\" value=\"30\"/>", "turbidity 30"},
      {"sunsky", "<integer name=\"month\" value=\"13\"/>", "month 13"},
      {"sunsky", "<float name=\"hour\" value=\"23\"/>", "below the horizon"},
      {"area", "<rgb name=\"radiance\" value=\"-1\"/>", "radiance is negative"}};
  for (const Bad& bad : cases) {
    const std::string error = Content(Dialect::current).error_of(light(bad.type, bad.body));
    EXPECT_NE(error.find(bad.says), std::string::npos) << bad.type << bad.body << ": " << error;
    EXPECT_NE(error.find("scene.xml\":"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace waylight::mitsuba
