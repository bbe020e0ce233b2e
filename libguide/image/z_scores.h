#pragma once
// Whether two pictures differ by more than their noise: z = (x - ref) / sigma of the difference.

#include <cstdint>

#include "libguide/image/image.h"

namespace waylight {

struct ZDistribution {
  // Shares of a normal distribution, two-sided.
  static constexpr double kBeyond2ByChance = 0.045500, kBeyond3ByChance = 0.002700;

  uint64_t count = 0;  // of scores: three channels each
  uint64_t beyond2 = 0, beyond3 = 0;
  double mean = 0, stddev = 0, largest = 0;  // largest |z|
  // Colours that differ though their variance is zero: no noise explains them.
  uint64_t unexplained = 0;

  double expected2() const { return kBeyond2ByChance * static_cast<double>(count); }
  double expected3() const { return kBeyond3ByChance * static_cast<double>(count); }
};

struct ZScores {
  ZDistribution pixels;
  // Means over square tiles (smaller at the right and lower border). Noise of pixels is far from
  // normal at few samples; that of tiles is closer, and a bias that pixels hide shows here. Assumes
  // independent pixels: a reconstruction filter wider than a pixel widens the scores of tiles.
  ZDistribution tiles;
};

// `variance` is that of x - ref; `floor` a deviation that every difference may have beside it.
// Colours without variance that are equal, and pixels that are not finite, have no score. Throws
// Misuse when sizes differ or tile_size < 1, Error when a variance is negative.
ZScores z_scores(const Bitmap& image, const Bitmap& reference, const Bitmap& variance,
                 int tile_size = 8, double floor = 0);

}  // namespace waylight
