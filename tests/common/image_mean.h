#pragma once
// The mean of a render that has variance channels.

#include "libguide/image/image.h"
#include "libguide/math/types.h"

namespace waylight::testing {

struct Mean {
  Color value = Color::Zero(), sigma = Color::Zero();  // and its standard error
};

inline Mean mean_of(const Image& image) {
  Mean mean;
  const float pixels = static_cast<float>(image.width * image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        mean.value[c] += image.at(x, y, c) / pixels;
        mean.sigma[c] += image.at(x, y, 3 + c) / sqr(pixels);
      }
  mean.sigma = mean.sigma.sqrt();
  return mean;
}

}  // namespace waylight::testing
