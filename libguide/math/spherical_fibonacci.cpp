#include "libguide/math/spherical_fibonacci.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace waylight {
namespace {

constexpr double kGolden = std::numbers::phi;
constexpr int kBruteForce = 16;  // so few points are compared one by one

// frac(i (golden ratio - 1)) to 2^-32, whatever i.
float golden_fraction(uint32_t i) { return static_cast<float>(i * 2654435769u) * 0x1p-32f; }

struct Nearest {
  int index = 0;
  float cosine = -2;

  void offer(const Vec3& w, int i, int count) {
    const float cosine_i = w.dot(hemisphere_fibonacci(i, count));
    if (cosine_i > cosine || (cosine_i == cosine && i < index)) *this = {i, cosine_i};
  }
};

// Signed azimuth, in turns, from a point to the one `step` indices later.
float turns_of(int step) {
  const float f = golden_fraction(static_cast<uint32_t>(step));
  return f < 0.5f ? f : f - 1;
}

// F_k and F_k+1 of the zone of w: the steps in index to the two nearest neighbours.
std::array<int, 2> zone_steps(float sin2, int count) {
  const float area = std::sqrt(5.0f) * kPi * (2.0f * count) * sin2;
  const float k = std::max(2.0f, std::floor(std::log(area) / (2 * std::log(float(kGolden)))));
  const double power = std::pow(kGolden, k) / std::sqrt(5.0);
  return {static_cast<int>(std::lround(power)), static_cast<int>(std::lround(power * kGolden))};
}

}  // namespace

Vec3 hemisphere_fibonacci(int i, int count) {
  const float phi = 2 * kPi * golden_fraction(static_cast<uint32_t>(i));
  const float down = (i + 0.5f) / count;  // 1 - z
  const float radius = safe_sqrt(down * (2 - down));
  return {radius * std::cos(phi), radius * std::sin(phi), 1 - down};
}

int nearest_hemisphere_fibonacci(const Vec3& w, int count) {
  Nearest nearest;
  if (count <= kBruteForce) {
    for (int i = 0; i < count; ++i) nearest.offer(w, i, count);
    return nearest.index;
  }
  // Coordinates of w in the lattice about point 0: turns = c0 t0 + c1 t1, steps = c0 F0 + c1 F1.
  const std::array<int, 2> steps = zone_steps(std::max(1 - sqr(w.z()), 1e-9f), count);
  const float t0 = turns_of(steps[0]), t1 = turns_of(steps[1]);
  const float turns = std::atan2(w.y(), w.x()) / (2 * kPi);
  const float index = (1 - std::max(w.z(), 0.0f)) * count - 0.5f;
  const float determinant = t0 * steps[1] - t1 * steps[0];
  const int c0 = static_cast<int>(std::floor((turns * steps[1] - t1 * index) / determinant));
  const int c1 = static_cast<int>(std::floor((t0 * index - turns * steps[0]) / determinant));
  for (int a = c0 - 1; a <= c0 + 2; ++a)
    for (int b = c1 - 1; b <= c1 + 2; ++b) {
      // Beyond the pole the indices come back: -1 - i is as near to it as i.
      const int i = a * steps[0] + b * steps[1];
      nearest.offer(w, std::clamp(i < 0 ? -1 - i : i, 0, count - 1), count);
    }
  return nearest.index;
}

}  // namespace waylight
