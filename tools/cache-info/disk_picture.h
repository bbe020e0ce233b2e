#pragma once
// A density over the equal-area disk (math/warp.h) as a square of pixels, +x to the right and +y
// up.

#include <functional>
#include <string>
#include <vector>

#include "libguide/math/types.h"

namespace waylight {

class DiskPicture {
 public:
  explicit DiskPicture(int size) : size_(size), values_(size_t(size) * size) {}

  void fill(const std::function<double(const Vec2& y)>& density);
  void add(const Vec2& y, double weight);
  // Square blocks of so many pixels get their mean: what a histogram of few samples needs.
  void average_blocks(int pixels);
  // Makes the integral over the disk 1, where it is not 0.
  void normalize();
  void divide(double by);  // where that is not 0

  int size() const { return size_; }
  double at(int x, int y) const { return values_[size_t(y) * size_ + x]; }
  double largest() const;
  Vec2 center(int x, int y) const;  // of a pixel, on the disk

 private:
  double pixel_area() const;

  int size_;
  std::vector<double> values_;
};

// Side by side, all on the scale of the largest value of the first. Writes a PNG.
void write_disks(const std::string& path, const std::vector<DiskPicture>& pictures);

}  // namespace waylight
