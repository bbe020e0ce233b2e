#include "libguide/image/z_scores.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

using Sum = Eigen::Array3d;

class ZCounter {
 public:
  // A difference and the variance of it, per channel.
  void add(const Sum& difference, const Sum& variance) {
    for (int c = 0; c < 3; ++c) {
      if (variance[c] > 0)
        add_score(difference[c] / std::sqrt(variance[c]));
      else if (difference[c] != 0)
        ++result_.unexplained;
    }
  }

  ZDistribution finish() {
    if (result_.count > 0) {
      const auto count = static_cast<double>(result_.count);
      result_.mean = sum_ / count;
      result_.stddev = std::sqrt(std::max(squares_ / count - result_.mean * result_.mean, 0.0));
    }
    return result_;
  }

 private:
  void add_score(double z) {
    ++result_.count;
    result_.beyond2 += std::abs(z) > 2;
    result_.beyond3 += std::abs(z) > 3;
    result_.largest = std::max(result_.largest, std::abs(z));
    sum_ += z;
    squares_ += z * z;
  }

  ZDistribution result_;
  double sum_ = 0, squares_ = 0;
};

void check(const Bitmap& image, const Bitmap& reference, const Bitmap& variance, int tile_size) {
  for (const Bitmap* other : {&reference, &variance})
    require(other->width == image.width && other->height == image.height,
            "the image has {} x {} pixels, the picture it is compared with {} x {}", image.width,
            image.height, other->width, other->height);
  require(tile_size >= 1, "a tile of {} pixels has no scores", tile_size);
  for (size_t i = 0; i < variance.pixels.size(); ++i)
    if ((variance.pixels[i] < 0).any())
      fail("the variance of pixel ({}, {}) is negative", i % variance.width, i / variance.width);
}

// Adds the pixels of one tile, and the tile itself when any of its pixels counts.
void add_tile(const Bitmap& image, const Bitmap& reference, const Bitmap& variance, int x0, int y0,
              int tile_size, double floor, ZCounter& pixels, ZCounter& tiles) {
  Sum difference = Sum::Zero(), variances = Sum::Zero();
  double count = 0;
  for (int y = y0; y < std::min(y0 + tile_size, image.height); ++y) {
    for (int x = x0; x < std::min(x0 + tile_size, image.width); ++x) {
      const Color &value = image.at(x, y), &ref = reference.at(x, y), &var = variance.at(x, y);
      if (!is_finite(value) || !is_finite(ref) || !is_finite(var)) continue;
      const Sum pixel_difference = value.cast<double>() - ref.cast<double>();
      pixels.add(pixel_difference, var.cast<double>() + floor * floor);
      difference += pixel_difference;
      variances += var.cast<double>();
      ++count;
    }
  }
  tiles.add(difference, variances + count * floor * count * floor);
}

}  // namespace

ZScores z_scores(const Bitmap& image, const Bitmap& reference, const Bitmap& variance,
                 int tile_size, double floor) {
  check(image, reference, variance, tile_size);
  ZCounter pixels, tiles;
  for (int y = 0; y < image.height; y += tile_size)
    for (int x = 0; x < image.width; x += tile_size)
      add_tile(image, reference, variance, x, y, tile_size, floor, pixels, tiles);
  return {pixels.finish(), tiles.finish()};
}

}  // namespace waylight
