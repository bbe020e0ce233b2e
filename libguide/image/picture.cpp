#include "libguide/image/picture.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

// The old pixels [first, first + weights.size()) under one new pixel and the share of each.
struct Footprint {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Footprint> footprints(int old_size, int new_size, PixelQuantity quantity) {
  std::vector<Footprint> all(new_size);
  const double ratio = static_cast<double>(old_size) / new_size;
  for (int i = 0; i < new_size; ++i) {
    const double begin = i * ratio, end = std::min<double>((i + 1) * ratio, old_size);
    all[i].first = static_cast<int>(begin);
    for (int j = all[i].first; j < end && j < old_size; ++j) {
      const double share = (std::min(end, j + 1.0) - std::max(begin, double(j))) / ratio;
      all[i].weights.push_back(
          static_cast<float>(quantity == PixelQuantity::mean ? share : share * share));
    }
  }
  return all;
}

Bitmap blank(int width, int height) {
  Bitmap bitmap;
  bitmap.width = width;
  bitmap.height = height;
  bitmap.pixels.assign(static_cast<size_t>(width) * height, Color::Zero());
  return bitmap;
}

Color& pixel(Bitmap& bitmap, int x, int y) {
  return bitmap.pixels[static_cast<size_t>(y) * bitmap.width + x];
}

Bitmap shrink_rows(const Bitmap& picture, int width, PixelQuantity quantity) {
  Bitmap result = blank(width, picture.height);
  const std::vector<Footprint> columns = footprints(picture.width, width, quantity);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width; ++x)
      for (size_t j = 0; j < columns[x].weights.size(); ++j)
        pixel(result, x, y) +=
            picture.at(columns[x].first + static_cast<int>(j), y) * columns[x].weights[j];
  return result;
}

Bitmap shrink_columns(const Bitmap& picture, int height, PixelQuantity quantity) {
  Bitmap result = blank(picture.width, height);
  const std::vector<Footprint> rows = footprints(picture.height, height, quantity);
  for (int y = 0; y < height; ++y)
    for (size_t j = 0; j < rows[y].weights.size(); ++j)
      for (int x = 0; x < picture.width; ++x)
        pixel(result, x, y) +=
            picture.at(x, rows[y].first + static_cast<int>(j)) * rows[y].weights[j];
  return result;
}

}  // namespace

bool has_color(const Image& image, const std::string& prefix) {
  return image.find(prefix + "R") >= 0 && image.find(prefix + "G") >= 0 &&
         image.find(prefix + "B") >= 0;
}

Bitmap color_of(const Image& image, const std::string& prefix) {
  if (!has_color(image, prefix)) fail("there are no channels {0}R, {0}G, {0}B", prefix);
  const int r = image.find(prefix + "R"), g = image.find(prefix + "G"),
            b = image.find(prefix + "B");
  Bitmap colors = blank(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      pixel(colors, x, y) = Color(image.at(x, y, r), image.at(x, y, g), image.at(x, y, b));
  return colors;
}

Bitmap crop(const Bitmap& picture, const PixelWindow& window) {
  require(window.x >= 0 && window.y >= 0 && window.width > 0 && window.height > 0 &&
              window.width <= picture.width && window.x <= picture.width - window.width &&
              window.height <= picture.height && window.y <= picture.height - window.height,
          "the crop window {},{},{},{} is not inside the {} x {} pixels", window.x, window.y,
          window.width, window.height, picture.width, picture.height);
  Bitmap part = blank(window.width, window.height);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      pixel(part, x, y) = picture.at(window.x + x, window.y + y);
  return part;
}

Bitmap downsample(const Bitmap& picture, int width, int height, PixelQuantity quantity) {
  require(width > 0 && height > 0 && width <= picture.width && height <= picture.height,
          "{} x {} pixels cannot be reduced to {} x {}", picture.width, picture.height, width,
          height);
  const double proportional_height = static_cast<double>(picture.height) * width / picture.width;
  require(std::abs(proportional_height - height) <= 1,
          "{} x {} pixels have other proportions than {} x {}", picture.width, picture.height,
          width, height);
  return shrink_columns(shrink_rows(picture, width, quantity), height, quantity);
}

}  // namespace waylight
