#pragma once
// Rectangular arrays of float pixels with named channels, row 0 on top.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "libguide/math/types.h"

namespace waylight {

// An image of any number of named channels, interleaved: what an EXR file holds.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  // for example "R", "G", "B", "variance.R", "depth.Z"
  std::vector<float> pixels;          // width * height * channels.size()

  Image() = default;
  Image(int w, int h, std::vector<std::string> names)
      : width(w), height(h), channels(std::move(names)),
        pixels(static_cast<size_t>(w) * h * channels.size()) {}

  float& at(int x, int y, size_t channel) {
    return pixels[(static_cast<size_t>(y) * width + x) * channels.size() + channel];
  }
  float at(int x, int y, size_t channel) const {
    return pixels[(static_cast<size_t>(y) * width + x) * channels.size() + channel];
  }
  // Index of the channel of that name, or -1.
  int find(const std::string& name) const {
    for (size_t i = 0; i < channels.size(); ++i)
      if (channels[i] == name) return static_cast<int>(i);
    return -1;
  }
};

// Linear sRGB pixels of a texture or environment map. `alpha` is empty or one value per pixel.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<Color> pixels;
  std::vector<float> alpha;

  const Color& at(int x, int y) const { return pixels[static_cast<size_t>(y) * width + x]; }
};

}  // namespace waylight
