#pragma once
// Vectors, colours and rays. Vectors are Eigen's: never bind an Eigen expression to `auto`.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace waylight {

using Vec2 = Eigen::Vector2f;
using Vec3 = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3f;
using Mat4 = Eigen::Matrix4f;
using Color = Eigen::Array3f;  // linear sRGB; products are component-wise

inline constexpr float kPi = std::numbers::pi_v<float>;
inline constexpr float kInvPi = std::numbers::inv_pi_v<float>;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;  // the largest float below 1

inline float sqr(float v) { return v * v; }
inline float safe_sqrt(float v) { return std::sqrt(std::max(v, 0.0f)); }
inline float lerp(float a, float b, float t) { return (1 - t) * a + t * b; }

// Relative luminance of linear sRGB (Rec. 709 primaries).
inline float luminance(const Color& c) {
  return 0.212671f * c.x() + 0.715160f * c.y() + 0.072169f * c.z();
}
inline bool is_black(const Color& c) { return c.maxCoeff() <= 0; }
inline bool is_finite(const Color& c) { return c.isFinite().all(); }

struct Ray {
  Vec3 origin;
  Vec3 direction;  // unit length
  float t_max = kInfinity;

  Vec3 operator()(float t) const { return origin + t * direction; }
};

struct Bounds {
  Vec3 min = Vec3::Constant(kInfinity);
  Vec3 max = Vec3::Constant(-kInfinity);

  void extend(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void extend(const Bounds& b) {
    min = min.cwiseMin(b.min);
    max = max.cwiseMax(b.max);
  }
  bool empty() const { return !(min.array() <= max.array()).all(); }
  Vec3 center() const { return 0.5f * (min + max); }
  float radius() const { return empty() ? 0.0f : 0.5f * (max - min).norm(); }
};

}  // namespace waylight
