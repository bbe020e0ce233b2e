#pragma once
// The mean of several renders of one picture, and how well it is known.

#include <span>

#include "libguide/image/image.h"

namespace waylight {

struct MeanPicture {
  Bitmap mean;
  Bitmap variance;  // of the mean, sum (x_i - mean)^2 / (n (n - 1)); zero of a single picture
};

// Throws Misuse when there is none, or their sizes differ.
MeanPicture mean_picture(std::span<const Bitmap> pictures);

}  // namespace waylight
