#pragma once
// How far a picture is from its reference. Only colours are compared, in linear sRGB.

#include <cstdint>

#include "libguide/image/image.h"

namespace waylight {

// Added to the square of the reference in relative errors, so that black pixels do not rule.
inline constexpr double kRelativeErrorFloor = 0.01;
// Share of the pixels, those of largest error, that the trimmed figure leaves out.
inline constexpr double kTrimmedShare = 0.001;

// Means over pixels and channels, of the pixels that are finite in all pictures.
struct CompareFigures {
  double mse = 0;             // (x - ref)^2
  double relmse = 0;          // (x - ref)^2 / (ref^2 + 0.01)
  double relmse_trimmed = 0;  // the same without 0.1 % of the pixels (rounded down)
  double mape = 0;            // |x - ref| / (|ref| + 0.01), 1 is 100 %
  double mean = 0, ref_mean = 0;
  uint64_t pixels = 0;      // compared
  uint64_t non_finite = 0;  // left out

  double mean_ratio() const { return mean / ref_mean; }
};

// Pictures of equal size. Throws Misuse otherwise. noise: variance of each pixel of the reference,
// which is taken from every squared error: what is left is, in the mean, the error against the image
// that the reference is an estimate of. Single pixels, and figures well below the noise, may be
// negative then.
CompareFigures compare(const Bitmap& image, const Bitmap& reference, const Bitmap* noise = nullptr);

// The relative squared error of each pixel, mean of its channels; NaN where one is not finite.
std::vector<float> relative_errors(const Bitmap& image, const Bitmap& reference);

// False colours of relative_errors: black 1e-4 and below, then violet, red, orange, to pale yellow
// at 1 and above, equal steps of colour for equal ratios; green where the error is not finite.
Bitmap false_color(const std::vector<float>& errors, int width, int height);

}  // namespace waylight
