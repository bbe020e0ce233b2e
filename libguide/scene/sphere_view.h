#pragma once
// What arrives at a point from everywhere, as a square picture of the sphere.

#include <optional>

#include "libguide/math/warp.h"

namespace waylight {

// Directions on the equal-area disk about +z (direction_to_disk()), +x to the right and +y up: the
// upper hemisphere is the inner disk of half the area, and -z is the rim, which touches the sides
// of the largest square in the middle of the picture.
class SphereView {
 public:
  SphereView(const Vec3& point, int width, int height)
      : point_(point),
        middle_(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)),
        scale_(std::numbers::sqrt2_v<float> / middle_.minCoeff()) {}

  // pixel: (0, 0) is the corner at the top left. Nothing beyond the rim.
  std::optional<Ray> ray(const Vec2& pixel) const {
    const Vec2 y = scale_ * Vec2(pixel.x() - middle_.x(), middle_.y() - pixel.y());
    if (!(y.squaredNorm() <= 2)) return std::nullopt;
    return Ray{point_, disk_to_direction(y)};
  }
  // Where a place of the disk is.
  Vec2 pixel(const Vec2& y) const { return middle_ + Vec2(y.x(), -y.y()) / scale_; }

 private:
  Vec3 point_;
  Vec2 middle_;
  float scale_;
};

}  // namespace waylight
