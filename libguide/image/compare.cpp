#include "libguide/image/compare.h"

#include <array>

#include "libguide/base/error.h"

namespace waylight {
namespace {

void require_equal_size(const Bitmap& image, const Bitmap& reference) {
  require(image.width == reference.width && image.height == reference.height,
          "the image has {} x {} pixels, the reference {} x {}", image.width, image.height,
          reference.width, reference.height);
}

struct PixelErrors {
  double squared = 0, relative = 0, absolute = 0;  // means over the channels; relative: squared too
};

PixelErrors errors_of(const Color& x, const Color& ref, const Color& noise) {
  PixelErrors errors;
  for (int c = 0; c < 3; ++c) {
    const double difference = double{x[c]} - ref[c];
    const double squared = difference * difference - noise[c];
    errors.squared += squared / 3;
    errors.relative += squared / (double{ref[c]} * ref[c] + kRelativeErrorFloor) / 3;
    errors.absolute += std::abs(difference) / (std::abs(double{ref[c]}) + kRelativeErrorFloor) / 3;
  }
  return errors;
}

// Mean of all but the largest; the order of equal ones does not matter.
double trimmed_mean(std::vector<double>& errors) {
  const auto kept = static_cast<std::ptrdiff_t>(errors.size()) -
                    static_cast<std::ptrdiff_t>(kTrimmedShare * static_cast<double>(errors.size()));
  std::sort(errors.begin(), errors.end());
  double sum = 0;
  for (auto error = errors.begin(); error != errors.begin() + kept; ++error) sum += *error;
  return sum / static_cast<double>(kept);
}

// Colours at equal steps from 0 to 1, of monotone luminance.
Color heat(float t) {
  static const std::array<Color, 6> kColors{Color(0.0f, 0.0f, 0.0f),    Color(0.10f, 0.01f, 0.18f),
                                            Color(0.38f, 0.02f, 0.13f), Color(0.80f, 0.12f, 0.02f),
                                            Color(0.97f, 0.48f, 0.01f), Color(0.98f, 0.98f, 0.60f)};
  const float position = std::clamp(t, 0.0f, 1.0f) * (kColors.size() - 1);
  const size_t index = std::min(static_cast<size_t>(position), kColors.size() - 2);
  const float weight = position - static_cast<float>(index);
  return kColors[index] * (1 - weight) + kColors[index + 1] * weight;
}

}  // namespace

CompareFigures compare(const Bitmap& image, const Bitmap& reference, const Bitmap* noise) {
  require_equal_size(image, reference);
  if (noise) require_equal_size(*noise, reference);
  CompareFigures figures;
  std::vector<double> errors;
  errors.reserve(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const Color &x = image.pixels[i], &ref = reference.pixels[i];
    const Color own = noise ? noise->pixels[i] : Color(Color::Zero());
    if (!is_finite(x) || !is_finite(ref) || !is_finite(own)) continue;
    const PixelErrors pixel = errors_of(x, ref, own);
    errors.push_back(pixel.relative);
    figures.relmse += pixel.relative;
    figures.mse += pixel.squared;
    figures.mape += pixel.absolute;
    figures.mean += double{x[0]} + x[1] + x[2];
    figures.ref_mean += double{ref[0]} + ref[1] + ref[2];
  }
  figures.pixels = errors.size();
  figures.non_finite = image.pixels.size() - errors.size();
  if (errors.empty()) fail("no pixel is finite in both pictures");
  const auto count = static_cast<double>(errors.size());
  for (double* sum : {&figures.mse, &figures.relmse, &figures.mape}) *sum /= count;
  for (double* sum : {&figures.mean, &figures.ref_mean}) *sum /= 3 * count;
  figures.relmse_trimmed = trimmed_mean(errors);
  return figures;
}

std::vector<float> relative_errors(const Bitmap& image, const Bitmap& reference) {
  require_equal_size(image, reference);
  std::vector<float> errors;
  errors.reserve(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const bool finite = is_finite(image.pixels[i]) && is_finite(reference.pixels[i]);
    errors.push_back(finite
                         ? static_cast<float>(
                               errors_of(image.pixels[i], reference.pixels[i], Color::Zero()).relative)
                         : std::numeric_limits<float>::quiet_NaN());
  }
  return errors;
}

Bitmap false_color(const std::vector<float>& errors, int width, int height) {
  constexpr float kDecades = 4;  // below 1
  Bitmap colors;
  colors.width = width;
  colors.height = height;
  colors.pixels.reserve(errors.size());
  for (float error : errors)
    colors.pixels.push_back(std::isfinite(error)
                                ? heat(1 + std::log10(std::max(error, 1e-30f)) / kDecades)
                                : Color(0, 1, 0));
  return colors;
}

}  // namespace waylight
