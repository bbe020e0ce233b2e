#include "tools/cache-info/disk_picture.h"

#include <algorithm>
#include <numeric>

#include "formats/image_io.h"
#include "libguide/image/compare.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

constexpr float kSide = 2.9f;  // of the square, a little more than the disk's diameter
constexpr int kGap = 8;        // pixels between two pictures
const Color kOutside(0.05f, 0.05f, 0.05f), kRing(0.25f, 0.25f, 0.25f);

// The horizon, where |y| = 1, is one pixel wide.
bool on_ring(const Vec2& y, float pixel) { return std::abs(y.norm() - 1) < 0.5f * pixel; }

void draw(const DiskPicture& picture, double scale, int left, Image& canvas) {
  const int n = picture.size();
  std::vector<float> values(size_t(n) * n);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) values[size_t(y) * n + x] = float(picture.at(x, y) * scale);
  const Bitmap colors = false_color(values, n, n);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Vec2 place = picture.center(x, y);
      Color color = colors.at(x, y);
      if (place.squaredNorm() > kDiskMaxRadius2) color = kOutside;
      if (on_ring(place, kSide / n)) color = kRing;
      for (int c = 0; c < 3; ++c) canvas.at(left + x, y, c) = color[c];
    }
}

}  // namespace

Vec2 DiskPicture::center(int x, int y) const {
  const float pixel = kSide / size_;
  return {(x + 0.5f) * pixel - 0.5f * kSide, 0.5f * kSide - (y + 0.5f) * pixel};
}

double DiskPicture::pixel_area() const { return double(kSide) * kSide / size_ / size_; }

void DiskPicture::fill(const std::function<double(const Vec2& y)>& density) {
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      const Vec2 place = center(x, y);
      values_[size_t(y) * size_ + x] =
          place.squaredNorm() <= kDiskMaxRadius2 ? density(place) : 0.0;
    }
}

void DiskPicture::add(const Vec2& y, double weight) {
  const float pixel = kSide / size_;
  const int column = std::clamp(int((y.x() + 0.5f * kSide) / pixel), 0, size_ - 1);
  const int row = std::clamp(int((0.5f * kSide - y.y()) / pixel), 0, size_ - 1);
  values_[size_t(row) * size_ + column] += weight;
}

void DiskPicture::average_blocks(int pixels) {
  for (int top = 0; top < size_; top += pixels)
    for (int left = 0; left < size_; left += pixels) {
      const int bottom = std::min(top + pixels, size_), right = std::min(left + pixels, size_);
      double sum = 0;
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) sum += at(x, y);
      const double mean = sum / ((bottom - top) * (right - left));
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) values_[size_t(y) * size_ + x] = mean;
    }
}

void DiskPicture::normalize() {
  const double sum = std::accumulate(values_.begin(), values_.end(), 0.0) * pixel_area();
  divide(sum);
}

void DiskPicture::divide(double by) {
  if (by != 0)
    for (double& value : values_) value /= by;
}

double DiskPicture::largest() const { return *std::max_element(values_.begin(), values_.end()); }

void write_disks(const std::string& path, const std::vector<DiskPicture>& pictures) {
  const int count = static_cast<int>(pictures.size()), size = pictures[0].size();
  Image canvas(count * size + (count - 1) * kGap, size, {"R", "G", "B"});
  const double largest = pictures[0].largest();
  for (int i = 0; i < count; ++i)
    draw(pictures[i], largest > 0 ? 1 / largest : 0, i * (size + kGap), canvas);
  write_png(path, canvas);
}

}  // namespace waylight
