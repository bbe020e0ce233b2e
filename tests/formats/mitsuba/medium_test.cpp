#include "common/small_media.h"
#include "formats/mitsuba/content_fixture.h"
#include "formats/mitsuba/media.h"

namespace waylight::mitsuba {
namespace {

std::string medium(const std::string& type, const std::string& body = "") {
  return fmt::format("<medium type=\"{}\">{}</medium>", type, body);
}

// Two voxels along x, 1 and 3 times a scale, in the box [0, 2] x [0, 1] x [0, 1].
void write_grid(const std::string& path, float scale = 1) {
  std::ofstream out(path, std::ios::binary);
  const auto put = [&](const auto& v) { out.write(reinterpret_cast<const char*>(&v), sizeof v); };
  out.write("VOL\3", 4);
  for (const int32_t v : {1, 2, 1, 1, 1}) put(v);
  for (const float v : {0.0f, 0.0f, 0.0f, 2.0f, 1.0f, 1.0f, scale, 3 * scale}) put(v);
}

const std::string kGrid = "<string name=\"filename\" value=\"a.vol\"/>";
const std::string kAlbedo =
    "<volume name=\"albedo\" type=\"constvolume\"><float name=\"value\" value=\".9\"/></volume>";

Vec3 upper_corner(const VolumeTexture& volume) {
  const Mat4& m = std::get<std::shared_ptr<const VolumeGrid>>(volume)->grid_to_world;
  return (m * Eigen::Vector4f(1, 1, 1, 1)).head<3>();
}

TEST(MitsubaMedia, HomogeneousTakesScatteringAndAbsorption) {
  const auto m = Content(Dialect::old)
                     .medium<HomogeneousMedium>(medium("homogeneous",
                                                       "<rgb name=\"sigmaS\" value=\"1, 0, 3\"/>"
                                                       "<rgb name=\"sigmaA\" value=\"1, 0, 1\"/>"
                                                       "<float name=\"scale\" value=\"2\"/>"));
  expect_color(m.sigma_t, {4, 0, 8});
  expect_color(m.albedo, {0.5f, 0, 0.75f});
}

TEST(MitsubaMedia, HomogeneousTakesExtinctionAndAlbedo) {
  const auto m = Content(Dialect::current)
                     .medium<HomogeneousMedium>(medium("homogeneous",
                                                       "<rgb name=\"sigma_t\" value=\"1 2 3\"/>"
                                                       "<rgb name=\"albedo\" value=\".99 .5 .5\"/>"
                                                       "<float name=\"scale\" value=\"3\"/>"));
  expect_color(m.sigma_t, {3, 6, 9});
  expect_color(m.albedo, {0.99f, 0.5f, 0.5f});
}

TEST(MitsubaMedia, HomogeneousByDefaultIsSkinInTheOldDialect) {
  const auto old = Content(Dialect::old).medium<HomogeneousMedium>(medium("homogeneous"));
  expect_color(old.sigma_t, {0.772f, 1.05f, 1.49f});
  const auto current = Content(Dialect::current).medium<HomogeneousMedium>(medium("homogeneous"));
  expect_color(current.sigma_t, Color::Ones());
  expect_color(current.albedo, Color::Constant(0.75f));
}

TEST(MitsubaMedia, PresetsScatterMoreThanTheyAbsorbAndTakeAScale) {
  for (const std::string& name : known_media()) {
    const ScatteringPreset preset = *medium_preset(name);
    EXPECT_TRUE(preset.sigma_s.minCoeff() > 0 && preset.sigma_a.minCoeff() >= 0) << name;
    if (name != "ketchup") {  // a strong dye
      EXPECT_GT(preset.sigma_s.mean(), 2 * preset.sigma_a.mean()) << name;
    }
  }
  const auto milk =
      Content(Dialect::old)
          .medium<HomogeneousMedium>(medium("homogeneous",
                                            "<string name=\"material\" value=\"Wholemilk\"/>"
                                            "<float name=\"scale\" value=\"100\"/>"));
  EXPECT_NEAR(milk.sigma_t.x(), 255.11f, 1e-2f);
}

TEST(MitsubaMedia, PhaseFunctionsAreIsotropicOrHenyeyGreenstein) {
  const auto phase = [](Dialect dialect, const std::string& body) {
    Content content(dialect);
    content.import(medium("homogeneous", body));
    return content.scene.media.back().phase;
  };
  for (const Dialect dialect : kBoth) {
    EXPECT_TRUE(std::holds_alternative<IsotropicPhase>(phase(dialect, "")));
    EXPECT_TRUE(
        std::holds_alternative<IsotropicPhase>(phase(dialect, "<phase type=\"isotropic\"/>")));
    EXPECT_EQ(std::get<HenyeyGreenstein>(phase(dialect, "<phase type=\"hg\"/>")).g, 0.8f);
    const PhaseFunction back =
        phase(dialect, "<phase type=\"hg\"><float name=\"g\" value=\"-.3\"/></phase>");
    EXPECT_EQ(std::get<HenyeyGreenstein>(back).g, -0.3f);
  }
}

TEST(MitsubaMedia, HeterogeneousOfTheOldDialectTakesDensityAndAlbedo) {
  Content content(Dialect::old);
  write_grid(content.file("a.vol"));
  const auto m = content.medium<HeterogeneousMedium>(
      medium("heterogeneous",
             "<string name=\"method\" value=\"woodcock\"/>"
             "<volume name=\"density\" type=\"gridvolume\">" +
                 kGrid +
                 "<transform name=\"toWorld\"><translate x=\"1\"/></transform>"
                 "</volume>" +
                 kAlbedo + "<float name=\"scale\" value=\"100\"/>"));
  EXPECT_EQ(m.scale, 100);
  expect_color(std::get<Color>(m.albedo), Color::Constant(0.9f));
  EXPECT_EQ(upper_corner(m.density), Vec3(3, 1, 1));
}

TEST(MitsubaMedia, MinAndMaxOfTheOldDialectReplaceTheBoxOfTheFile) {
  Content content(Dialect::old);
  write_grid(content.file("a.vol"));
  const auto m = content.medium<HeterogeneousMedium>(medium(
      "heterogeneous", "<volume name=\"density\" type=\"gridvolume\">" + kGrid +
                           "<point name=\"max\" x=\"5\" y=\"6\" z=\"7\"/></volume>" + kAlbedo));
  EXPECT_EQ(upper_corner(m.density), Vec3(5, 6, 7));
}

TEST(MitsubaMedia, ValuesOfVolFilesStandOnTheSidesOfTheBoxInTheOldDialectOnly) {
  const auto on_sides = [](Dialect dialect, const std::string& name) {
    Content content(dialect);
    write_grid(content.file("a.vol"));
    const auto m = content.medium<HeterogeneousMedium>(
        medium("heterogeneous", fmt::format("<volume name=\"{}\" type=\"gridvolume\">", name) +
                                    kGrid + "</volume>" + kAlbedo));
    return std::get<std::shared_ptr<const VolumeGrid>>(m.density)->values_on_sides;
  };
  EXPECT_TRUE(on_sides(Dialect::old, "density"));
  EXPECT_FALSE(on_sides(Dialect::current, "sigma_t"));
}

TEST(MitsubaMedia, TheNewDialectTakesTheBoxOfTheFileOnRequestOnly) {
  const auto corner = [](const std::string& body) {
    Content content(Dialect::current);
    write_grid(content.file("a.vol"));
    const auto m = content.medium<HeterogeneousMedium>(
        medium("heterogeneous", "<volume name=\"sigma_t\" type=\"gridvolume\">" + kGrid + body +
                                    "</volume><rgb name=\"albedo\" value=\".99 .5 .5\"/>"));
    return upper_corner(m.density);
  };
  const std::string to_world =
      "<transform name=\"to_world\"><scale x=\"3\" y=\"3\" z=\"3\"/></transform>";
  EXPECT_EQ(corner(to_world), Vec3(3, 3, 3));
  EXPECT_EQ(corner("<boolean name=\"use_grid_bbox\" value=\"true\"/>" + to_world), Vec3(6, 3, 3));
}

TEST(MitsubaMedia, MaxValueSaysWhatTheLargestVoxelStandsFor) {
  Content content(Dialect::current);
  write_grid(content.file("a.vol"));
  const auto m = content.medium<HeterogeneousMedium>(
      medium("heterogeneous", "<volume name=\"sigma_t\" type=\"gridvolume\">" + kGrid +
                                  "<float name=\"max_value\" value=\"6\"/></volume>"));
  const auto grid = std::get<std::shared_ptr<const VolumeGrid>>(m.density);
  EXPECT_EQ(waylight::testing::dense_values(grid->voxels), (std::vector<float>{2, 6}));
  expect_color(std::get<Color>(m.albedo), Color::Constant(0.75f));
}

MediumEmission emission_of(Content& content, const std::string& type, const std::string& body) {
  content.import(medium(type, body));
  return content.scene.media.back().emission;
}

const std::string kEmission = "<rgb name=\"emission\" value=\"1 2 3\"/>";

TEST(MitsubaMedia, EmissionIsAColourTimesItsScale) {
  Content content(Dialect::current);
  EXPECT_FALSE(emits(emission_of(content, "homogeneous", "")));
  for (const char* type : {"homogeneous", "heterogeneous"}) {
    const MediumEmission emission =
        emission_of(content, type, kEmission + "<float name=\"emission_scale\" value=\"2\"/>");
    EXPECT_TRUE(emits(emission));
    expect_color(std::get<Color>(emission.radiance), {1, 2, 3});
    expect_color(emission.scale, Color::Constant(2));
  }
}

TEST(MitsubaMedia, EmissionMayBeAGridOfAHeterogeneousMedium) {
  Content content(Dialect::current);
  write_grid(content.file("a.vol"));
  const std::string volume = "<volume name=\"emission\" type=\"gridvolume\">" + kGrid + "</volume>";
  const MediumEmission emission = emission_of(
      content, "heterogeneous", volume + "<rgb name=\"emission_scale\" value=\"1 .5 .1\"/>");
  const auto grid = std::get<std::shared_ptr<const VolumeGrid>>(emission.radiance);
  EXPECT_EQ(waylight::testing::dense_values(grid->voxels), (std::vector<float>{1, 3}));
  expect_color(emission.scale, {1, 0.5f, 0.1f});
  EXPECT_NE(content.error_of(medium("homogeneous", volume)).find("emission varies"),
            std::string::npos);
}

TEST(MitsubaMedia, OneGridServesAllWhoReferToIt) {
  Content content(Dialect::current);
  write_grid(content.file("a.vol"));
  content.import("<volume type=\"gridvolume\" id=\"v\">" + kGrid + "</volume>" +
                 medium("heterogeneous",
                        "<ref name=\"sigma_t\" id=\"v\"/>"
                        "<ref name=\"emission\" id=\"v\"/>"));
  const Medium& glowing = content.scene.media.back();
  using Grid = std::shared_ptr<const VolumeGrid>;
  EXPECT_EQ(std::get<Grid>(std::get<HeterogeneousMedium>(glowing.coefficients).density),
            std::get<Grid>(glowing.emission.radiance));
}

TEST(MitsubaMedia, EmissionOfAMediumThatDoesNotAbsorbIsWarnedOf) {
  const std::string white = "<float name=\"albedo\" value=\"1\"/>";
  for (const char* type : {"homogeneous", "heterogeneous"}) {
    Content content(Dialect::current);
    content.import(medium(type, kEmission));
    EXPECT_TRUE(content.warnings.empty());
    content.import(medium(type, kEmission + white));
    ASSERT_EQ(content.warnings.size(), 1u);
    EXPECT_NE(content.warnings[0].find("emits nothing"), std::string::npos);
  }
}

TEST(MitsubaMedia, DamagedGridsNameGridAndElement) {
  Content content(Dialect::current);
  write_grid(content.file("a.vol"));
  std::filesystem::resize_file(content.file("a.vol"), 50);
  const std::string error = content.error_of(medium(
      "heterogeneous", "\n<volume name=\"sigma_t\" type=\"gridvolume\">" + kGrid + "</volume>"));
  EXPECT_NE(error.find("scene.xml\":3: <volume type=\"gridvolume\">"), std::string::npos) << error;
  EXPECT_NE(error.find("a.vol"), std::string::npos) << error;
}

TEST(MitsubaMedia, NegativeCoefficientsOfHeterogeneousMediaAreNamed) {
  for (const char* name : {"sigma_t", "albedo", "emission"}) {
    const std::string property = fmt::format("<float name=\"{}\" value=\"-1\"/>", name);
    const std::string error = Content(Dialect::current).error_of(medium("heterogeneous", property));
    EXPECT_NE(error.find(fmt::format("its {} is negative", name)), std::string::npos) << error;
  }
}

TEST(MitsubaMedia, ExtinctionBeyondWhatFlightsResolveIsNamed) {
  const std::string cloud =
      "<volume name=\"density\" type=\"gridvolume\">" + kGrid + "</volume>" + kAlbedo;
  const auto error = [&](const std::string& type, const std::string& body, const char* scale) {
    Content content(Dialect::old);
    write_grid(content.file("a.vol"));
    return content.error_of(
        medium(type, body + fmt::format("<float name=\"scale\" value=\"{}\"/>", scale)));
  };
  EXPECT_EQ(error("heterogeneous", cloud, "1e5"), "no error");
  EXPECT_NE(error("heterogeneous", cloud, "1e6").find("mean free paths"), std::string::npos);
  EXPECT_NE(error("heterogeneous", cloud, "2e38").find("not finite"), std::string::npos);
  const std::string fog =
      "<float name=\"sigmaT\" value=\"9\"/><float name=\"albedo\" value=\"1\"/>";
  EXPECT_EQ(error("homogeneous", fog, "1e30"), "no error");
  EXPECT_NE(error("homogeneous", fog, "2e38").find("not finite"), std::string::npos);
}

TEST(MitsubaMedia, MaxValueTooLargeForItsGridIsNamed) {
  Content content(Dialect::current);
  write_grid(content.file("a.vol"), 1e-5f);
  const std::string error = content.error_of(
      medium("heterogeneous", "<volume name=\"sigma_t\" type=\"gridvolume\">" + kGrid +
                                  "<float name=\"max_value\" value=\"1e38\"/></volume>"));
  EXPECT_NE(error.find("max_value is too large"), std::string::npos) << error;
}

TEST(MitsubaMedia, WrongMediaAreNamed) {
  struct Bad {
    const char* type;
    std::string body;
    const char* says;
  };
  const std::string grid = "<volume name=\"{}\" type=\"gridvolume\">" + kGrid + "</volume>";
  const Bad cases[] = {
      {"homogenous", "", "did you mean \"homogeneous\"?"},
      {"homogeneous", "<string name=\"material\" value=\"marbel\"/>", "did you mean \"marble\"?"},
      {"homogeneous", "<rgb name=\"sigmaS\" value=\"1\"/>", "both sigma_s and sigma_a"},
      {"homogeneous", "<rgb name=\"sigmaT\" value=\"1\"/>", "both sigma_t and albedo"},
      {"homogeneous",
       "<rgb name=\"sigmaS\" value=\"1\"/><string name=\"material\" value=\"marble\"/>",
       "one of the three"},
      {"homogeneous", "<rgb name=\"sigmaS\" value=\"-1\"/><rgb name=\"sigmaA\" value=\"1\"/>",
       "sigma_s is negative"},
      {"homogeneous", "<rgb name=\"sigmaT\" value=\"1\"/><rgb name=\"albedo\" value=\"1.5\"/>",
       "albedo is above 1"},
      {"homogeneous", "<float name=\"scale\" value=\"-1\"/>", "scale is negative"},
      {"homogeneous", "<rgb name=\"emission\" value=\"-1 0 0\"/>", "emission is negative"},
      {"homogeneous", kEmission + "<float name=\"emissionScale\" value=\"-1\"/>",
       "emission_scale is negative"},
      {"homogeneous", "<float name=\"emissionScale\" value=\"1\"/>", "without an emission"},
      {"homogeneous", "<phase type=\"rayleigh\"/>", "known are hg, isotropic"},
      {"homogeneous", "<phase type=\"hg\"><float name=\"g\" value=\"1\"/></phase>", "mean cosine"},
      {"heterogeneous", kAlbedo, "needs a <volume> \"density\""},
      {"heterogeneous", "<volume name=\"density\" type=\"gridvolume\"/>" + kAlbedo,
       "needs a filename"},
      {"heterogeneous", "<volume name=\"density\" type=\"gridvolum\"/>" + kAlbedo,
       "did you mean \"gridvolume\"?"},
      {"heterogeneous",
       fmt::format(fmt::runtime(grid), "density") + fmt::format(fmt::runtime(grid), "albedo"),
       "albedo is above 1"}};
  for (const Bad& bad : cases) {
    Content content(Dialect::old);
    write_grid(content.file("a.vol"));
    const std::string error = content.error_of(medium(bad.type, bad.body));
    EXPECT_NE(error.find(bad.says), std::string::npos) << bad.type << bad.body << ": " << error;
  }
}

}  // namespace
}  // namespace waylight::mitsuba
