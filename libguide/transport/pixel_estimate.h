#pragma once
// The pixel estimate I of guided roulette and splitting, from a preview.

#include "libguide/transport/preview.h"

namespace waylight {

// Luminance expected of each block: a joint bilateral filter [Petschnigg et al. 2004] over 7 x 7
// blocks, steered by normal, albedo and depth. A block brighter than twice the median of its 3 x 3
// neighbourhood counts as that much: a firefly would end the paths of all pixels around.
std::vector<float> filter_preview(const Preview& preview);

// Luminance expected of each pixel. An estimate: it changes the variance of a render alone.
class PixelEstimates {
 public:
  PixelEstimates() = default;
  explicit PixelEstimates(const Preview& preview);

  // At a pixel of the film, which must be one of the preview's; linear between the centres of
  // blocks. 0 without a preview and where it is black.
  float at(int x, int y) const;

 private:
  int first_column_ = 0, first_row_ = 0, columns_ = 0, rows_ = 0;
  std::vector<float> luminance_;
};

}  // namespace waylight
