#pragma once
// Small operations on pictures that are about to be compared.

#include "libguide/image/image.h"

namespace waylight {

// A rectangle of pixels, (0, 0) on top left.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

bool has_color(const Image& image, const std::string& prefix = "");

// Channels prefix + R, G, B. Throws Error when the image lacks one.
Bitmap color_of(const Image& image, const std::string& prefix = "");

// Throws Misuse unless the window is inside the picture and not empty.
Bitmap crop(const Bitmap& picture, const PixelWindow& window);

// What a pixel of the smaller picture is made of, for `downsample`.
enum class PixelQuantity {
  mean,     // of the area it covers
  variance  // of such a mean, when the pixels are independent: weights are squared
};

// Each pixel becomes the mean over the area that it covers. Throws Misuse when it would enlarge the
// picture or change its proportions by more than a pixel.
Bitmap downsample(const Bitmap& picture, int width, int height,
                  PixelQuantity quantity = PixelQuantity::mean);

}  // namespace waylight
