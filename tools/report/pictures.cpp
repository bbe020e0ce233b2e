#include "tools/report/pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/file_bytes.h"
#include "formats/image_io.h"
#include "libguide/image/compare.h"

namespace waylight {
namespace {

constexpr int kCropShare = 5;  // of the picture's width and height

// Means of the variance channels over those of the squared picture, as in relMSE.
double estimated_error(const Bitmap& picture, const Bitmap& variance) {
  double sum = 0;
  for (size_t i = 0; i < picture.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double value = picture.pixels[i][c];
      sum += variance.pixels[i][c] / (value * value + kRelativeErrorFloor);
    }
  return sum / static_cast<double>(3 * picture.pixels.size());
}

// From the statistics beside the reference, else from its variance channels.
std::optional<double> reference_error(const std::string& path, const Image& reference) {
  const std::string stats = std::filesystem::path(path).replace_extension(".json");
  if (std::filesystem::exists(stats)) {
    const auto json = nlohmann::json::parse(read_whole_file(stats), nullptr, false);
    if (json.is_object() && json.contains("estimated_relmse") &&
        json["estimated_relmse"].is_number())
      return json["estimated_relmse"].get<double>();
  }
  if (!has_color(reference, "variance.")) return std::nullopt;
  return estimated_error(color_of(reference), color_of(reference, "variance."));
}

Bitmap colors_in(const Image& image, const std::string& path) {
  if (!has_color(image)) fail("\"{}\": has no channels R, G, B", path);
  return color_of(image);
}

// A reference may be larger than the images.
Bitmap fitted(Bitmap reference, const Bitmap& image, const Checkpoint& row) {
  if (reference.width == image.width && reference.height == image.height) return reference;
  if (reference.width < image.width || reference.height < image.height)
    fail("\"{}\": has {} x {} pixels, more than its reference \"{}\" with {} x {}", row.image,
         image.width, image.height, row.reference, reference.width, reference.height);
  return downsample(reference, image.width, image.height);
}

// One pixel of large error shall not decide.
double mean_error(const Shot& shot, const PixelWindow& w) {
  double sum = 0;
  for (int y = w.y; y < w.y + w.height; ++y)
    for (int x = w.x; x < w.x + w.width; ++x) {
      const float error = shot.errors[static_cast<size_t>(y) * shot.picture.width + x];
      sum += std::isfinite(error) ? std::min(error, 1.0f) : 1.0f;
    }
  return sum / (static_cast<double>(w.width) * w.height);
}

double spread(const std::vector<Shot>& methods, const PixelWindow& window) {
  double low = INFINITY, high = 0;
  for (const Shot& shot : methods) {
    const double error = mean_error(shot, window);
    low = std::min(low, error);
    high = std::max(high, error);
  }
  return high - low;
}

PixelWindow choose_crop(const std::vector<Shot>& methods) {
  const Bitmap& first = methods[0].picture;
  PixelWindow window{0, 0, std::max(1, first.width / kCropShare),
                     std::max(1, first.height / kCropShare)};
  PixelWindow best = window;
  double most = -1;
  const int step_x = std::max(1, window.width / 2), step_y = std::max(1, window.height / 2);
  for (window.y = 0; window.y + window.height <= first.height; window.y += step_y)
    for (window.x = 0; window.x + window.width <= first.width; window.x += step_x)
      if (const double difference = spread(methods, window); difference > most) {
        most = difference;
        best = window;
      }
  return best;
}

std::vector<Shot> read_methods(const SceneRuns& scene) {
  std::vector<Shot> shots;
  for (const Method& method : scene.methods) {
    const std::string& path = method.last().image;
    Shot& shot = shots.emplace_back();
    shot.picture = colors_in(read_image(path, &shot.attributes), path);
    if (shot.picture.width != shots[0].picture.width ||
        shot.picture.height != shots[0].picture.height)
      fail("\"{}\" and \"{}\" differ in size; render all methods of a scene with one --size", path,
           scene.methods[0].last().image);
  }
  return shots;
}

}  // namespace

Pictures read_pictures(const SceneRuns& scene, const std::optional<PixelWindow>& crop) {
  const Checkpoint& row = scene.methods[0].last();
  Pictures pictures;
  pictures.methods = read_methods(scene);
  const Image reference = read_image(row.reference, &pictures.reference.attributes);
  pictures.reference_error = reference_error(row.reference, reference);
  pictures.reference.picture =
      fitted(colors_in(reference, row.reference), pictures.methods[0].picture, row);
  for (Shot& shot : pictures.methods)
    shot.errors = relative_errors(shot.picture, pictures.reference.picture);
  pictures.crop = crop ? *crop : choose_crop(pictures.methods);
  return pictures;
}

}  // namespace waylight
