#include "formats/mitsuba/content_fixture.h"
#include "formats/mitsuba/textures.h"
#include "formats/srgb.h"

namespace waylight::mitsuba {
namespace {

// Two by two, 8 bit: top row red and green, bottom row blue and mid grey.
void write_picture(const std::string& path) {
  Image image(2, 2, {"R", "G", "B"});
  const Color rows[] = {
      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Color::Constant(srgb_to_linear(128 / 255.f))};
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) image.at(i % 2, i / 2, c) = rows[i][c];
  write_png(path, image);
}

Texture picture(Dialect dialect, const std::string& body = "") {
  Content content(dialect);
  write_picture(content.file("a.png"));
  return content.texture(
      "<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"a.png\"/>" +
      body + "</texture>");
}

const Vec2 kBottomLeft(0.25f, 0.25f), kBottomRight(0.75f, 0.25f), kTopLeft(0.25f, 0.75f);

TEST(MitsubaTextures, TheBottomRowOfABitmapIsAtVZero) {
  for (const Dialect dialect : kBoth) {
    const Texture texture = picture(dialect);
    expect_color(texture.eval(kBottomLeft), {0, 0, 1});
    expect_color(texture.eval(kTopLeft), {1, 0, 0});
  }
}

TEST(MitsubaTextures, AMaskWhoseAlphaChannelIsNotReadIsWarnedOf) {
  const auto warnings = [](const std::string& channel) {
    Content content(Dialect::old);
    Image image(2, 1, {"R", "G", "B", "A"});
    image.pixels = {1, 1, 1, 0, 0, 1, 0, 1};
    write_exr(content.file("leaf.exr"), image, {});
    content.import(
        "<bsdf type=\"mask\"><bsdf type=\"diffuse\"/><texture type=\"bitmap\" name=\"opacity\">"
        "<string name=\"filename\" value=\"leaf.exr\"/>" +
        channel + "</texture></bsdf>");
    return content.warnings.size();
  };
  EXPECT_EQ(warnings(""), 1u);
  EXPECT_EQ(warnings("<string name=\"channel\" value=\"a\"/>"), 0u);
}

TEST(MitsubaTextures, PicturesAreSrgbUnlessRawOrOfGammaOne) {
  const float linear = srgb_to_linear(128 / 255.0f), raw = 128 / 255.0f;
  const auto grey = [](const Texture& t) { return t.eval(kBottomRight).x(); };
  EXPECT_NEAR(grey(picture(Dialect::old)), linear, 1e-3f);
  EXPECT_NEAR(grey(picture(Dialect::old, "<float name=\"gamma\" value=\"1\"/>")), raw, 1e-3f);
  EXPECT_NEAR(grey(picture(Dialect::old, "<float name=\"gamma\" value=\"-1\"/>")), linear, 1e-3f);
  EXPECT_NEAR(grey(picture(Dialect::current, "<boolean name=\"raw\" value=\"true\"/>")), raw,
              1e-3f);
}

TEST(MitsubaTextures, FiltersAndWrapModesAreThoseAskedFor) {
  const auto modes = [](const Texture& t) { return std::get<BitmapTexture>(t.source); };
  const BitmapTexture plain = modes(picture(Dialect::current));
  EXPECT_EQ(plain.filter, TextureFilter::bilinear);
  EXPECT_EQ(plain.wrap_u, WrapMode::repeat);
  const BitmapTexture old = modes(picture(Dialect::old,
                                          "<string name=\"filterType\" value=\"ewa\"/>"
                                          "<string name=\"wrapMode\" value=\"clamp\"/>"
                                          "<string name=\"wrapModeV\" value=\"mirror\"/>"));
  EXPECT_EQ(old.filter, TextureFilter::bilinear);
  EXPECT_EQ(old.wrap_u, WrapMode::clamp);
  EXPECT_EQ(old.wrap_v, WrapMode::mirror);
  EXPECT_EQ(
      modes(picture(Dialect::current, "<string name=\"filter_type\" value=\"nearest\"/>")).filter,
      TextureFilter::nearest);
}

// In Mitsuba v = 0 is the top: shifting v by a quarter of the picture from there moves down.
TEST(MitsubaTextures, UvTransformsActOnMitsubasCoordinates) {
  const Texture current =
      picture(Dialect::current,
              "<string name=\"filter_type\" value=\"nearest\"/><transform name=\"to_uv\">"
              "<scale x=\"0.5\" y=\"0.5\"/></transform>");
  const Texture old = picture(Dialect::old,
                              "<string name=\"filterType\" value=\"nearest\"/>"
                              "<float name=\"uscale\" value=\".5\"/>"
                              "<float name=\"vscale\" value=\".5\"/>");
  for (const Texture& texture : {current, old})
    expect_color(texture.eval({0.9f, 0.1f}), {1, 0, 0});  // only the top left quarter is seen
  const Texture moved = picture(Dialect::old,
                                "<string name=\"filterType\" value=\"nearest\"/>"
                                "<float name=\"voffset\" value=\".5\"/>"
                                "<float name=\"uoffset\" value=\".5\"/>");
  expect_color(moved.eval(kBottomRight), {1, 0, 0});
}

TEST(MitsubaTextures, AChannelOfABitmapIsGrey) {
  const Texture red = picture(Dialect::old, "<string name=\"channel\" value=\"r\"/>");
  expect_color(red.eval(kTopLeft), Color::Ones());
  expect_color(red.eval(kBottomLeft), Color::Zero());
  Content content(Dialect::old);
  write_picture(content.file("a.png"));
  EXPECT_NE(content
                .error_of(with_type("diffuse",
                                    "<texture type=\"bitmap\" name=\"reflectance\"><string "
                                    "name=\"filename\" value=\"a.png\"/><string name=\"channel\" "
                                    "value=\"a\"/></texture>"))
                .find("alpha channel"),
            std::string::npos);
}

TEST(MitsubaTextures, APictureIsReadOncePerColourSpace) {
  Content content(Dialect::current);
  write_picture(content.file("a.png"));
  const auto bitmap = [&](const std::string& body) {
    const Texture texture = content.texture(
        "<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" "
        "value=\"a.png\"/>" +
        body + "</texture>");
    return std::get<BitmapTexture>(texture.source).bitmap;
  };
  const auto first = bitmap(""), raw = bitmap("<boolean name=\"raw\" value=\"true\"/>");
  EXPECT_EQ(first, bitmap(""));
  EXPECT_NE(first, raw);
}

TEST(MitsubaTextures, OnePictureServesAllWhoReferToIt) {
  Content content(Dialect::current);
  write_picture(content.file("a.png"));
  content.import(
      "<texture type=\"bitmap\" id=\"t\"><string name=\"filename\" value=\"a.png\"/>"
      "<string name=\"channel\" value=\"r\"/></texture>" +
      with_type("diffuse", "<ref name=\"reflectance\" id=\"t\"/>") +
      with_type("diffuse", "<ref name=\"reflectance\" id=\"t\"/>"));
  const auto bitmap = [&](int material) {
    const auto& diffuse = std::get<DiffuseMaterial>(content.scene.materials.at(material).model);
    return std::get<BitmapTexture>(diffuse.reflectance.source).bitmap;
  };
  EXPECT_EQ(bitmap(0), bitmap(1));
}

// color0 where both coordinates are in the same half of Mitsuba's uv, v counted from the top.
TEST(MitsubaTextures, CheckerboardHasItsFirstColourAtMitsubasOrigin) {
  for (const Dialect dialect : kBoth) {
    const Texture plain =
        Content(dialect).texture("<texture type=\"checkerboard\" name=\"reflectance\"/>");
    EXPECT_EQ(plain.eval(kTopLeft).x(), 0.4f);
    EXPECT_EQ(plain.eval(kBottomLeft).x(), 0.2f);
  }
  const Texture fine = Content(Dialect::current)
                           .texture(
                               "<texture type=\"checkerboard\" name=\"reflectance\">"
                               "<rgb name=\"color0\" value=\"1\"/>"
                               "<rgb name=\"color1\" value=\"0\"/><transform name=\"to_uv\">"
                               "<scale x=\"20\" y=\"80\"/></transform></texture>");
  EXPECT_EQ(fine.eval({0.01f, 0.999f}).x(), 1);
  EXPECT_EQ(fine.eval({0.04f, 0.999f}).x(), 0);
  EXPECT_EQ(fine.eval({0.01f, 0.991f}).x(), 0);
}

TEST(MitsubaTextures, CheckerboardTakesTexturesThatAreOneColour) {
  const Texture board = Content(Dialect::old)
                            .texture(
                                "<texture type=\"checkerboard\" name=\"reflectance\"><texture "
                                "type=\"scale\" name=\"color0\">"
                                "<rgb name=\"value\" value=\"1 .5 0\"/><float name=\"scale\" "
                                "value=\".5\"/></texture></texture>");
  expect_color(board.eval(kTopLeft), {0.5f, 0.25f, 0});
}

TEST(MitsubaTextures, DamagedPicturesNamePictureAndElement) {
  Content content(Dialect::current);
  std::ofstream(content.file("a.png")) << "no picture";
  const std::string error = content.error_of(
      "<bsdf type=\"diffuse\">\n<texture type=\"bitmap\" name=\"reflectance\">"
      "<string name=\"filename\" value=\"a.png\"/></texture></bsdf>");
  EXPECT_NE(error.find("scene.xml\":3: <texture type=\"bitmap\">"), std::string::npos) << error;
  EXPECT_NE(error.find("a.png"), std::string::npos) << error;
}

TEST(MitsubaTextures, ScaleMultipliesColoursBoardsAndPictures) {
  const auto scaled = [](const std::string& nested, const std::string& factor) {
    Content content(Dialect::old);
    write_picture(content.file("a.png"));
    return content.texture("<texture type=\"scale\" name=\"reflectance\">" + nested + factor +
                           "</texture>");
  };
  const std::string half = "<float name=\"scale\" value=\".5\"/>";
  const std::string red = "<rgb name=\"scale\" value=\"1 0 0\"/>";
  const std::string board = "<texture type=\"checkerboard\"/>";
  const std::string bitmap =
      "<texture type=\"bitmap\"><string name=\"filename\" value=\"a.png\"/></texture>";
  EXPECT_EQ(scaled(board, half).eval(kTopLeft).x(), 0.2f);
  expect_color(scaled(board, red).eval(kTopLeft), {0.4f, 0, 0});
  expect_color(scaled(bitmap, half).eval(kTopLeft), {0.5f, 0, 0});
  expect_color(scaled(bitmap, red).eval(kBottomLeft), {0, 0, 0});
  expect_color(scaled("<rgb name=\"value\" value=\".2 .4 .6\"/>", half).mean(), {.1f, .2f, .3f});
}

TEST(MitsubaTextures, ANegativeScaleOfAPictureIsAnError) {
  for (const char* factor :
       {"<float name=\"scale\" value=\"-1\"/>", "<rgb name=\"scale\" value=\"1 0 -1\"/>"}) {
    Content content(Dialect::old);
    write_picture(content.file("a.png"));
    const std::string error = content.error_of(with_type(
        "diffuse",
        fmt::format("<texture type=\"scale\" name=\"reflectance\"><texture type=\"bitmap\">"
                    "<string name=\"filename\" value=\"a.png\"/></texture>{}</texture>",
                    factor)));
    EXPECT_NE(error.find("negative"), std::string::npos) << error;
  }
}

TEST(MitsubaTextures, WrongTexturesAreNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"<texture type=\"bitmep\" name=\"reflectance\"/>", "did you mean \"bitmap\"?"},
      {"<texture type=\"bitmap\" name=\"reflectance\"/>", "needs a filename"},
      {"<texture type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" value=\"no.png\"/>"
       "</texture>",
       "there is no file \"no.png\""},
      {"<texture type=\"checkerboard\" name=\"reflectance\"><rgb name=\"colour0\" value=\"1\"/>"
       "</texture>",
       "did you mean \"color0\"?"},
      {"<texture type=\"checkerboard\" name=\"reflectance\">"
       "<texture type=\"checkerboard\" name=\"color1\"/></texture>",
       "its color1 is a <texture>"},
      {"<texture type=\"checkerboard\" name=\"reflectance\"><float name=\"color0\" value=\"-1\"/>"
       "</texture>",
       "its reflectance is negative"},
      {"<texture type=\"scale\" name=\"reflectance\"><rgb name=\"value\" value=\"1\"/>"
       "<float name=\"scale\" value=\"-1\"/></texture>",
       "its reflectance is negative"},
      {"<texture type=\"scale\" name=\"reflectance\"/>", "needs a nested texture"}};
  for (const auto& [body, says] : cases) {
    const std::string error = Content(Dialect::current).error_of(with_type("diffuse", body));
    EXPECT_NE(error.find(says), std::string::npos) << body << error;
  }
}

}  // namespace
}  // namespace waylight::mitsuba
