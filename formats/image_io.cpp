#include "formats/image_io.h"

#include <array>

#include "formats/image_codecs.h"
#include "formats/srgb.h"
#include "libguide/base/error.h"

namespace waylight {
namespace {

constexpr long long kMaxPixels = 1ll << 28, kMaxNumbers = 1ll << 30;

// Where red, green and blue are: R, G, B, or one channel for all three.
std::array<int, 3> color_channels(const Image& image, const std::string& path) {
  const std::array<int, 3> rgb{image.find("R"), image.find("G"), image.find("B")};
  if (rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0) return rgb;
  const int grey = image.find("Y") >= 0 ? image.find("Y") : 0;
  if (image.channels.size() != 1 && image.find("Y") < 0)
    fail("\"{}\": a texture needs channels R, G, B or Y", path);
  return {grey, grey, grey};
}

// Radiance and reflectance are not negative: what lies outside the gamut is moved to its border.
Bitmap to_bitmap(const Image& image, const std::string& path) {
  const std::array<int, 3> rgb = color_channels(image, path);
  const int alpha = image.find("A");
  Bitmap bitmap;
  bitmap.width = image.width;
  bitmap.height = image.height;
  bitmap.pixels.reserve(static_cast<size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Color color(image.at(x, y, rgb[0]), image.at(x, y, rgb[1]), image.at(x, y, rgb[2]));
      if (!is_finite(color) || (alpha >= 0 && !std::isfinite(image.at(x, y, alpha))))
        fail("\"{}\": pixel ({}, {}) is not finite; repair the picture", path, x, y);
      bitmap.pixels.push_back(color.max(0.0f));
      if (alpha >= 0) bitmap.alpha.push_back(std::clamp(image.at(x, y, alpha), 0.0f, 1.0f));
    }
  }
  return bitmap;
}

}  // namespace

void check_image_size(const std::string& path, long long width, long long height, size_t channels) {
  if (width <= 0 || height <= 0 || channels == 0) fail("\"{}\": the picture is empty", path);
  if (width > kMaxPixels / height ||
      static_cast<long long>(channels) > kMaxNumbers / (width * height))
    fail("\"{}\": {} x {} pixels with {} channels are too many (at most 2^28 pixels, 2^30 numbers)",
         path, width, height, channels);
}

Bitmap read_bitmap(const std::string& path, ColorSpace space) {
  if (!is_exr(path)) return to_bitmap(read_picture(path, space), path);
  Bitmap bitmap = to_bitmap(read_exr(path, nullptr), path);
  if (space == ColorSpace::srgb)
    for (Color& color : bitmap.pixels)
      for (float& value : color) value = srgb_to_linear(value);
  return bitmap;
}

Image read_image(const std::string& path, std::map<std::string, std::string>* attributes) {
  return is_exr(path) ? read_exr(path, attributes) : read_picture(path, ColorSpace::automatic);
}

}  // namespace waylight
