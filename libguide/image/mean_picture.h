#pragma once
// The mean of several renders of one picture, or of their variances.

#include <span>

#include "libguide/image/image.h"

namespace waylight {

// Throws Misuse when there is none, or their sizes differ.
Bitmap mean_picture(std::span<const Bitmap> pictures);

}  // namespace waylight
