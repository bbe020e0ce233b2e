#include "libguide/scene/camera.h"

#include "libguide/base/error.h"
#include "libguide/math/warp.h"

namespace waylight {
namespace {

void check(const SensorDescription& sensor) {
  if (sensor.film.width <= 0 || sensor.film.height <= 0)
    fail("sensor: a film of {} x {} pixels has no pixels", sensor.film.width, sensor.film.height);
  if (!(sensor.fov > 0 && sensor.fov < kPi))
    fail("sensor: the field of view must lie between 0 and 180 degrees");
  if (!sensor.to_world.allFinite()) fail("sensor: its transform is not finite");
  if (!(sensor.aperture_radius >= 0 && sensor.focus_distance > 0))
    fail("sensor: needs an aperture radius of at least 0 and a focus distance above 0");
}

// Width over height.
float aspect(const FilmDescription& film) {
  return static_cast<float>(film.width) / static_cast<float>(film.height);
}

}  // namespace

float tan_half_fov_x(const SensorDescription& sensor) {
  const float t = std::tan(0.5f * sensor.fov), width = aspect(sensor.film);
  FovAxis axis = sensor.fov_axis;
  if (axis == FovAxis::smaller) axis = width <= 1 ? FovAxis::x : FovAxis::y;
  if (axis == FovAxis::larger) axis = width > 1 ? FovAxis::x : FovAxis::y;
  if (axis == FovAxis::x) return t;
  return axis == FovAxis::y ? t * width : t / std::sqrt(1 + 1 / (width * width));
}

Camera::Camera(const SensorDescription& sensor)
    : width_(sensor.film.width),
      height_(sensor.film.height),
      rotation_(sensor.to_world.topLeftCorner<3, 3>()),
      origin_(sensor.to_world.topRightCorner<3, 1>()),
      tan_half_fov_x_(tan_half_fov_x(sensor)),
      aspect_(aspect(sensor.film)),
      aperture_radius_(sensor.aperture_radius),
      focus_distance_(sensor.focus_distance),
      principal_(sensor.principal_x, sensor.principal_y) {
  check(sensor);
}

Ray Camera::ray(const Vec2& pixel, const Vec2& u_lens) const {
  const float s = pixel.x() / static_cast<float>(width_) + principal_.x();
  const float t = pixel.y() / static_cast<float>(height_) + principal_.y();
  const Vec3 forward((1 - 2 * s) * tan_half_fov_x_, (1 - 2 * t) * tan_half_fov_x_ / aspect_, 1);
  if (aperture_radius_ == 0) return {origin_, (rotation_ * forward).normalized()};
  const Vec2 disk = aperture_radius_ * square_to_disk(u_lens);
  const Vec3 lens(disk.x(), disk.y(), 0);
  return {origin_ + rotation_ * lens,
          (rotation_ * (focus_distance_ * forward - lens)).normalized()};
}

}  // namespace waylight
