#include "libguide/bsdf/microfacet.h"

namespace waylight {
namespace {

// w in the space where the distribution is isotropic with alpha = 1.
Vec3 stretched(const Vec3& w, float alpha_u, float alpha_v) {
  return Vec3(alpha_u * w.x(), alpha_v * w.y(), w.z()).normalized();
}

// Inverse of erf on (-1, 1), relative error below 4e-7 after the polynomial of [Giles 2012].
float erf_inverse(float x) {
  float w = -std::log((1 - x) * (1 + x));
  float p;
  if (w < 5) {
    w -= 2.5f;
    p = 2.81022636e-08f;
    for (float c : {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 0.00021858087f,
                    -0.00125372503f, -0.00417768164f, 0.246640727f, 1.50140941f})
      p = c + p * w;
  } else {
    w = std::sqrt(w) - 3;
    p = -0.000200214257f;
    for (float c : {0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f,
                    -0.0076224613f, 0.00943887047f, 1.00167406f, 2.83297682f})
      p = c + p * w;
  }
  return p * x;
}

constexpr float kErfLimit = 1 - 1.2e-7f;

// Slope along w seen under elevation of cotangent c: its density is proportional to
// (c - x) exp(-x^2) for x < c. With b = erf(x) the distribution function is
//   C(b) = c (1 + b) + exp(-x^2) / sqrt(pi),   C'(b) = c - x,
// smooth enough for Newton inside a bracket [Jakob 2014, An Improved Visible Normal Sampling
// Routine for the Beckmann Distribution].
float visible_slope(float c, float u) {
  constexpr float kInvSqrtPi = std::numbers::inv_sqrtpi_v<float>;
  float low = -kErfLimit, high = std::min(std::erf(c), kErfLimit);
  const float total = c * (1 + high) + kInvSqrtPi * std::exp(-sqr(c));
  const float target = u * total;
  // Jakob's cubic in the elevation starts close to the root.
  const float theta = std::atan(1 / c);
  const float power = 1 + theta * (-0.876f + theta * (0.4265f - 0.0594f * theta));
  float b = high - (1 + high) * std::pow(1 - u, power), x = 0;
  for (int i = 0; i < 12; ++i) {
    if (!(b > low && b < high)) b = 0.5f * (low + high);
    x = erf_inverse(b);
    const float error = c * (1 + b) + kInvSqrtPi * std::exp(-sqr(x)) - target;
    if (std::abs(error) < 5e-6f * total || !(high - low > 1e-7f)) break;
    (error > 0 ? high : low) = b;
    b -= error / std::max(c - x, 1e-8f);
  }
  return x;
}

}  // namespace

// Visible normals of the hemisphere are halfway between w and a uniform cap [Dupuy, Benyoub 2023].
Vec3 Microfacet::sample_ggx(const Vec3& w, const Vec2& u2) const {
  const Vec3 v = stretched(w, alpha_u, alpha_v);
  const float z = (1 - u2.y()) * (1 + v.z());  // of the sum; at least the smallest normal float
  const float cap = z - v.z();
  const float r = safe_sqrt((1 - cap) * (1 + cap)), phi = 2 * kPi * u2.x();
  const float x = r * std::cos(phi) + v.x(), y = r * std::sin(phi) + v.y();
  return Vec3(alpha_u * x, alpha_v * y, std::max(z, 1e-12f)).normalized();
}

Vec3 Microfacet::sample_beckmann(const Vec3& w, const Vec2& u2) const {
  const Vec3 v = stretched(w, alpha_u, alpha_v);
  const float r = std::hypot(v.x(), v.y());
  const Vec2 along = r > 0 ? Vec2(v.x() / r, v.y() / r) : Vec2(1, 0);
  const float x = visible_slope(std::min(v.z() / std::max(r, 1e-12f), 1e6f), u2.x());
  const float y = erf_inverse(std::clamp(2 * u2.y() - 1, -kErfLimit, kErfLimit));
  const float slope_u = along.x() * x - along.y() * y, slope_v = along.y() * x + along.x() * y;
  return Vec3(-alpha_u * slope_u, -alpha_v * slope_v, 1).normalized();
}

}  // namespace waylight
