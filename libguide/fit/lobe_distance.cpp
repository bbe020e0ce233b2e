#include "libguide/fit/lobe_distance.h"

#include <array>

namespace waylight {
namespace {

// Directions drawn from each lobe and from the hemisphere.
constexpr int kLobe = 96, kUniform = 64, kAll = 2 * kLobe + kUniform;

struct Point {
  float a = 0, b = 0;  // f / density
};

std::optional<Vec3> draw(const LobeTarget& a, const LobeTarget& b, int i) {
  Sampler sampler(0, 0, i);
  const float u = sampler.next();
  const Vec2 u2 = sampler.next_2d();
  if (i < kLobe) return a.sample(u, u2);
  if (i < 2 * kLobe) return b.sample(u, u2);
  return square_to_hemisphere(u2);
}

// Draws that fail have the value zero.
Point evaluate(const LobeTarget& a, const LobeTarget& b, int i) {
  const std::optional<Vec3> wi = draw(a, b, i);
  if (!wi) return {};
  const LobeTarget::Value at_a = a.evaluate(*wi), at_b = b.evaluate(*wi);
  const float density = kLobe * (at_a.pdf + at_b.pdf) + kUniform * kHemispherePdf;
  return {at_a.f / density, at_b.f / density};
}

}  // namespace

float lobe_distance(const LobeTarget& a, const LobeTarget& b) {
  std::array<Point, kAll> points;
  double sum_a = 0, sum_b = 0, difference = 0;
  for (int i = 0; i < kAll; ++i) {
    points[i] = evaluate(a, b, i);
    sum_a += points[i].a, sum_b += points[i].b;
  }
  if (!(sum_a > 0 && sum_b > 0)) return sum_a > 0 || sum_b > 0 ? 2 : 0;
  for (const Point& p : points) difference += std::abs(p.a / sum_a - p.b / sum_b);
  return static_cast<float>(difference);
}

}  // namespace waylight
