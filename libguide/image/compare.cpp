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

double relative_error(const Color& x, const Color& ref) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double difference = double{x[c]} - ref[c];
    sum += difference * difference / (double{ref[c]} * ref[c] + kRelativeErrorFloor);
  }
  return sum / 3;
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

CompareFigures compare(const Bitmap& image, const Bitmap& reference) {
  require_equal_size(image, reference);
  CompareFigures figures;
  std::vector<double> errors;
  errors.reserve(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const Color &x = image.pixels[i], &ref = reference.pixels[i];
    if (!is_finite(x) || !is_finite(ref)) continue;
    errors.push_back(relative_error(x, ref));
    figures.relmse += errors.back();
    for (int c = 0; c < 3; ++c) {
      const double difference = double{x[c]} - ref[c];
      figures.mse += difference * difference;
      figures.mape += std::abs(difference) / (std::abs(double{ref[c]}) + kRelativeErrorFloor);
      figures.mean += x[c];
      figures.ref_mean += ref[c];
    }
  }
  figures.pixels = errors.size();
  figures.non_finite = image.pixels.size() - errors.size();
  if (errors.empty()) fail("no pixel is finite in both pictures");
  const auto count = static_cast<double>(errors.size());
  for (double* sum : {&figures.mse, &figures.mape, &figures.mean, &figures.ref_mean})
    *sum /= 3 * count;
  figures.relmse /= count;
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
                         ? static_cast<float>(relative_error(image.pixels[i], reference.pixels[i]))
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
