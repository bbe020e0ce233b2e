#include "libguide/math/warp.h"

namespace waylight {

Vec2 square_to_disk(const Vec2& u) {
  const float a = 2 * u.x() - 1, b = 2 * u.y() - 1;
  if (a == 0 && b == 0) return Vec2::Zero();
  float r, phi;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    phi = kPi / 4 * (b / a);
  } else {
    r = b;
    phi = kPi / 2 - kPi / 4 * (a / b);
  }
  return {r * std::cos(phi), r * std::sin(phi)};
}

Vec2 disk_to_square(const Vec2& p) {
  const bool x_major = std::abs(p.x()) > std::abs(p.y());
  const float r = std::copysign(p.norm(), x_major ? p.x() : p.y());
  if (r == 0) return {0.5f, 0.5f};
  const float minor = r * (4 / kPi) * std::atan(x_major ? p.y() / p.x() : p.x() / p.y());
  const Vec2 centred = x_major ? Vec2(r, minor) : Vec2(minor, r);
  return 0.5f * (centred + Vec2::Ones());
}

Vec3 square_to_sphere(const Vec2& u) {
  const float r = 2 * safe_sqrt(u.x() * (1 - u.x())), phi = 2 * kPi * u.y();
  return {r * std::cos(phi), r * std::sin(phi), 1 - 2 * u.x()};
}

namespace {

float azimuth_to_unit(const Vec3& w) {
  const float phi = std::atan2(w.y(), w.x());
  return std::min((phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi), kOneMinusEpsilon);
}

}  // namespace

Vec2 sphere_to_square(const Vec3& w) { return {0.5f * (1 - w.z()), azimuth_to_unit(w)}; }

}  // namespace waylight
