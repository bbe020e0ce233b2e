#include "formats/mitsuba/textures.h"

#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

using Affine = Eigen::Matrix3f;  // of homogeneous texture coordinates

// Mitsuba's v = 0 is the top row of a picture, here it is the bottom one: v becomes 1 - v.
Affine flip_v() {
  Affine flip = Affine::Identity();
  flip(1, 1) = -1;
  flip(1, 2) = 1;
  return flip;
}

UvTransform to_uv(const Affine& m) {
  return {{m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2)}};
}

// `to_uv`, then the old dialect's u' = uscale u + uoffset, in Mitsuba's coordinates.
Affine uv_property(Properties& properties) {
  const Mat4 full = properties.transform("to_uv");
  Affine given, scaled = Affine::Identity();
  given << full(0, 0), full(0, 1), full(0, 3), full(1, 0), full(1, 1), full(1, 3), 0, 0, 1;
  const float scale = properties.number("uvscale", 1);
  scaled(0, 0) = properties.number("uscale", scale);
  scaled(1, 1) = properties.number("vscale", scale);
  scaled(0, 2) = properties.number("uoffset", 0);
  scaled(1, 2) = properties.number("voffset", 0);
  return scaled * given;
}

WrapMode wrap_property(Properties& properties, const std::string& name, WrapMode otherwise) {
  static const std::map<std::string, WrapMode> kModes = {{"repeat", WrapMode::repeat},
                                                         {"mirror", WrapMode::mirror},
                                                         {"clamp", WrapMode::clamp},
                                                         {"zero", WrapMode::zero},
                                                         {"one", WrapMode::one}};
  if (!properties.has(name)) return otherwise;
  return choose(properties, name, kModes, "repeat");
}

// Footprint filters have no place in a path tracer: many samples a pixel do their work.
TextureFilter filter_property(Properties& properties) {
  static const std::map<std::string, TextureFilter> kFilters = {
      {"bilinear", TextureFilter::bilinear},
      {"trilinear", TextureFilter::bilinear},
      {"ewa", TextureFilter::bilinear},
      {"nearest", TextureFilter::nearest}};
  return choose(properties, "filter_type", kFilters, "bilinear");
}

Texture color_or_texture(ImportContext& context, Properties& properties, const std::string& name,
                         const Texture& otherwise) {
  if (!properties.has(name)) return otherwise;
  if (const Element* object = properties.object(name)) return import_texture(context, *object);
  return Texture(properties.color(name, Color::Zero()));
}

// Of pictures that of their factor: files have pixels a little below 0 of colours that sRGB cannot
// show, which are left alone.
float least_value(const Texture& texture) {
  if (const auto* board = std::get_if<CheckerboardTexture>(&texture.source))
    return (texture.scale * board->color0.min(board->color1)).minCoeff();
  return texture.constant() ? texture.mean().minCoeff() : texture.scale;
}

// One channel as grey.
std::shared_ptr<const Bitmap> extract(Properties& properties, const Bitmap& bitmap, int channel) {
  if (channel == 3 && bitmap.alpha.empty())
    fail_at(properties.element(), "its picture has no alpha channel");
  auto grey = std::make_shared<Bitmap>(bitmap);
  for (size_t i = 0; i < grey->pixels.size(); ++i)
    grey->pixels[i] = Color::Constant(channel == 3 ? bitmap.alpha[i] : bitmap.pixels[i][channel]);
  grey->alpha.clear();
  return grey;
}

std::shared_ptr<const Bitmap> channel_property(Properties& properties,
                                               std::shared_ptr<const Bitmap> bitmap) {
  static const std::map<std::string, int> kChannels = {
      {"", -1}, {"r", 0}, {"g", 1}, {"b", 2}, {"a", 3}};
  const int channel = choose(properties, "channel", kChannels, "");
  return channel < 0 ? bitmap : extract(properties, *bitmap, channel);
}

Texture import_bitmap(ImportContext& context, Properties& properties) {
  const ColorSpace space = color_space_property(context, properties);
  BitmapTexture bitmap;
  bitmap.bitmap = channel_property(properties, bitmap_property(context, properties, space));
  bitmap.filter = filter_property(properties);
  const WrapMode both = wrap_property(properties, "wrap_mode", WrapMode::repeat);
  bitmap.wrap_u = wrap_property(properties, "wrap_mode_u", both);
  bitmap.wrap_v = wrap_property(properties, "wrap_mode_v", both);
  properties.ignore({"max_anisotropy", "cache", "format", "accel"});
  Texture texture;
  texture.source = bitmap;
  texture.to_uv = to_uv(flip_v() * uv_property(properties) * flip_v());
  return texture;
}

// A colour, or a texture that is one everywhere.
Color constant_property(ImportContext& context, Properties& properties, const std::string& name,
                        float otherwise) {
  const Texture texture = color_or_texture(context, properties, name, Texture(otherwise));
  if (texture.constant()) return texture.mean();
  fail_at(properties.element(), "its {} is a <texture>, which is not supported; give a colour",
          name);
}

Texture import_checkerboard(ImportContext& context, Properties& properties) {
  Texture texture;
  texture.source = CheckerboardTexture{constant_property(context, properties, "color0", 0.4f),
                                       constant_property(context, properties, "color1", 0.2f)};
  // The pattern keeps Mitsuba's coordinates, in which it is defined.
  texture.to_uv = to_uv(uv_property(properties) * flip_v());
  return texture;
}

void tint(Color& color, const Color& factor) { color *= factor; }
void tint(CheckerboardTexture& board, const Color& factor) {
  board.color0 *= factor;
  board.color1 *= factor;
}
void tint(BitmapTexture& texture, const Color& factor) {
  auto tinted = std::make_shared<Bitmap>(*texture.bitmap);
  for (Color& pixel : tinted->pixels) pixel *= factor;
  texture.bitmap = tinted;
}

// The old dialect's product of a texture, a colour or a number with a factor.
Texture import_scale(ImportContext& context, Properties& properties) {
  const Element* nested = single(properties, "texture");
  if (!nested && !properties.has("value"))
    fail_at(properties.element(), "needs a nested texture or a value");
  Texture texture =
      nested ? import_texture(context, *nested) : Texture(properties.color("value", Color::Ones()));
  const Color factor = properties.color("scale", Color::Ones());
  if ((factor == factor.x()).all()) {
    texture.scale *= factor.x();
    return texture;
  }
  if (factor.minCoeff() < 0) fail_at(properties.element(), "its scale is a negative colour");
  std::visit([&](auto& source) { tint(source, factor); }, texture.source);
  return texture;
}

std::shared_ptr<const Bitmap> read_picture(const Element& element, const std::string& path,
                                           ColorSpace space) {
  try {
    return std::make_shared<Bitmap>(read_bitmap(path, space));
  } catch (const Error& error) {
    fail_at(element, "{}", error.what());
  }
}

using TextureImporter = Texture (*)(ImportContext&, Properties&);
const std::map<std::string, TextureImporter> kImporters = {
    {"bitmap", import_bitmap}, {"checkerboard", import_checkerboard}, {"scale", import_scale}};

}  // namespace

ColorSpace color_space_property(ImportContext& context, Properties& properties) {
  if (properties.boolean("raw", false)) return ColorSpace::linear;
  const float gamma = properties.number("gamma", 0);
  if (gamma == 1) return ColorSpace::linear;
  if (gamma == -1) return ColorSpace::srgb;
  if (gamma == 0) return ColorSpace::automatic;
  if (!(std::abs(gamma - 2.2f) < 0.01f))
    fail_at(properties.element(), "gamma {} is not supported; 1 is linear, -1 sRGB", gamma);
  context.warn(fmt::format("{}: gamma 2.2 is taken as sRGB", properties.element().where()));
  return ColorSpace::srgb;
}

std::shared_ptr<const Bitmap> bitmap_property(ImportContext& context, Properties& properties,
                                              ColorSpace space) {
  const Element& element = properties.element();
  const std::string name = properties.text("filename", "");
  if (name.empty()) fail_at(element, "needs a filename");
  const std::string path = context.document.find_file(element, name);
  std::shared_ptr<const Bitmap>& known =
      context.bitmaps[fmt::format("{}:{}", static_cast<int>(space), path)];
  if (!known) known = read_picture(element, path, space);
  return known;
}

Texture import_texture(ImportContext& context, const Element& element) {
  if (element.tag != "texture") fail_at(element, "stands where a texture is needed");
  const auto known = context.textures.find(&element);
  if (known != context.textures.end()) return known->second;
  Properties properties(context.document, element);
  const TextureImporter importer = importer_of(element, kImporters, "texture");
  const Texture texture = importer(context, properties);
  properties.finish();
  return context.textures[&element] = texture;
}

Texture texture_property(ImportContext& context, Properties& properties, const std::string& name,
                         const Texture& otherwise) {
  const Texture texture = color_or_texture(context, properties, name, otherwise);
  if (least_value(texture) < 0) fail_at(properties.element(), "its {} is negative", name);
  return texture;
}

Texture reflectance_property(ImportContext& context, Properties& properties,
                             const std::string& name, const Texture& otherwise) {
  const Texture texture = texture_property(context, properties, name, otherwise);
  constexpr float kOne = 1.001f;  // white, as the samples of a spectrum give it
  if (properties.has(name) && texture.constant() && texture.mean().maxCoeff() > kOne)
    context.warn(
        fmt::format("{}: its {} is above 1 and is held there", properties.element().where(), name));
  return texture;
}

}  // namespace waylight::mitsuba
