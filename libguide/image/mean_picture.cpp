#include "libguide/image/mean_picture.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

using Sum = Eigen::Array3d;

void check_sizes(std::span<const Bitmap> pictures) {
  require(!pictures.empty(), "no picture has no mean");
  const Bitmap& first = pictures[0];
  for (const Bitmap& other : pictures)
    require(other.width == first.width && other.height == first.height,
            "a picture of {} x {} pixels has no mean with one of {} x {}", other.width,
            other.height, first.width, first.height);
}

void average_pixel(std::span<const Bitmap> pictures, size_t i, MeanPicture& result) {
  const auto n = static_cast<double>(pictures.size());
  Sum mean = Sum::Zero(), squares = Sum::Zero();
  for (const Bitmap& picture : pictures) mean += picture.pixels[i].cast<double>() / n;
  for (const Bitmap& picture : pictures)
    squares += (picture.pixels[i].cast<double>() - mean).square();
  result.mean.pixels[i] = mean.cast<float>();
  result.variance.pixels[i] = (squares / std::max(n * (n - 1), 1.0)).cast<float>();
}

}  // namespace

MeanPicture mean_picture(std::span<const Bitmap> pictures) {
  check_sizes(pictures);
  MeanPicture result{pictures[0], pictures[0]};
  for (size_t i = 0; i < result.mean.pixels.size(); ++i) average_pixel(pictures, i, result);
  return result;
}

}  // namespace waylight
