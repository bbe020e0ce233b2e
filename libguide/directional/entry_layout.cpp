#include "libguide/directional/entry_layout.h"

#include "libguide/math/frame.h"
#include "libguide/math/spherical_fibonacci.h"

namespace waylight {
namespace {

float entry_theta(int i, int n) { return (i + 0.5f) / n * (0.5f * kPi); }

// Within 7e-5 [Abramowitz, Stegun 1964, 4.4.45]; x in [0, 1].
float fast_acos(float x) {
  return std::sqrt(1 - x) * (1.5707288f + x * (-0.2121144f + x * (0.0742610f - x * 0.0187293f)));
}

// About the y axis, from the elevation of (s, 0, c) to that of wo = (horizontal, 0, z).
Mat3 tilt(float horizontal, float z, float s, float c) {
  const float sine = horizontal * c - z * s, cosine = z * c + horizontal * s;
  Mat3 rotation;
  rotation << cosine, 0, -sine, 0, 1, 0, sine, 0, cosine;
  return rotation;
}

// The least rotation of a to b, both unit vectors and not opposite.
Mat3 between(const Vec3& a, const Vec3& b) {
  const Vec3 axis = a.cross(b);  // times the sine
  const float cosine = a.dot(b), k = 1 / (1 + cosine);
  Mat3 rotation = k * axis * axis.transpose();
  rotation.diagonal().array() += cosine;
  rotation(0, 1) -= axis.z(), rotation(1, 0) += axis.z();
  rotation(0, 2) += axis.y(), rotation(2, 0) -= axis.y();
  rotation(1, 2) -= axis.x(), rotation(2, 1) += axis.x();
  return rotation;
}

Vec3 mirrored(const Vec3& w) { return {-w.x(), -w.y(), w.z()}; }

}  // namespace

Vec3 entry_wo(EntryLayout layout, int i, int n) {
  if (layout == EntryLayout::fibonacci) return hemisphere_fibonacci(i, n);
  const float theta = entry_theta(i, n);
  return {std::sin(theta), 0, std::cos(theta)};
}

int nearest_entry(EntryLayout layout, const Vec3& wo, int n) {
  if (layout == EntryLayout::fibonacci) return nearest_hemisphere_fibonacci(wo, n);
  const float theta = fast_acos(std::clamp(wo.z(), 0.0f, 1.0f));
  return std::min(static_cast<int>(theta * (2 * kInvPi) * n), n - 1);
}

Mat3 entry_rotation(EntryLayout layout, const Vec3& wo, int i, int n) {
  return entry_rotation(layout, wo, entry_wo(layout, i, n), n);
}

Mat3 entry_rotation(EntryLayout layout, const Vec3& wo, const Vec3& entry_wo, int n) {
  if (layout == EntryLayout::fibonacci) return between(mirrored(entry_wo), mirrored(wo));
  const Frame azimuth = Frame::from_tangent(Vec3::UnitZ(), {wo.x(), wo.y(), 0});
  Mat3 rotation;
  rotation << azimuth.s, azimuth.t, azimuth.n;
  if (n == 1) return rotation;
  return rotation * tilt(safe_sqrt(sqr(wo.x()) + sqr(wo.y())), wo.z(), entry_wo.x(), entry_wo.z());
}

}  // namespace waylight
