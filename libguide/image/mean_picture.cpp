#include "libguide/image/mean_picture.h"

#include "libguide/base/error.h"

namespace waylight {
namespace {

void check_sizes(std::span<const Bitmap> pictures) {
  require(!pictures.empty(), "no picture has no mean");
  const Bitmap& first = pictures[0];
  for (const Bitmap& other : pictures)
    require(other.width == first.width && other.height == first.height,
            "a picture of {} x {} pixels has no mean with one of {} x {}", other.width,
            other.height, first.width, first.height);
}

}  // namespace

Bitmap mean_picture(std::span<const Bitmap> pictures) {
  check_sizes(pictures);
  Bitmap mean = pictures[0];
  for (size_t i = 0; i < mean.pixels.size(); ++i) {
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (const Bitmap& picture : pictures) sum += picture.pixels[i].cast<double>();
    mean.pixels[i] = (sum / static_cast<double>(pictures.size())).cast<float>();
  }
  return mean;
}

}  // namespace waylight
