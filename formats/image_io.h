#pragma once
// Pictures in and out. Writers write to a temporary name and rename when complete.

#include <map>
#include <string>

#include "libguide/image/image.h"

namespace waylight {

// How the numbers in a picture are meant.
enum class ColorSpace {
  automatic,
  srgb,
  linear
};  // automatic: 8-bit files sRGB, float files linear

// Texture or environment map as linear sRGB: PNG, JPEG, TGA, HDR, EXR (by content, not suffix).
Bitmap read_bitmap(const std::string& path, ColorSpace space);

// All channels of an EXR (or R, G, B of any other readable picture), with its string attributes.
Image read_image(const std::string& path, std::map<std::string, std::string>* attributes = nullptr);

// ZIP-compressed, single part, 32-bit float or (half = true) 16-bit channels by name.
void write_exr(const std::string& path, const Image& image,
               const std::map<std::string, std::string>& attributes = {}, bool half = false);

// 8-bit sRGB picture of the R, G, B channels, clamped, times 2^exposure.
void write_png(const std::string& path, const Image& image, float exposure = 0);

// The content of such a PNG, and of a JPEG, which takes a fraction of the space where there is noise.
std::string png_bytes(const Bitmap& picture, float exposure = 0);
std::string jpeg_bytes(const Bitmap& picture, float exposure, int quality);

}  // namespace waylight
