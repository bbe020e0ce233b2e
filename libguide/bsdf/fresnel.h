#pragma once
// Fresnel's equations for unpolarised light, and the reflections and refractions they weigh.

#include "libguide/math/types.h"

namespace waylight {

struct Fresnel {
  float reflectance;  // in [0, 1]; the rest is transmitted
  float cos_t;        // of the refracted direction, >= 0; 0 under total internal reflection
};

// cos_i in [0, 1] on the side of incidence; eta = n(other side) / n(this side).
inline Fresnel fresnel_dielectric(float cos_i, float eta) {
  const float sin2_t = (1 - sqr(cos_i)) / sqr(eta);
  if (sin2_t >= 1) return {1, 0};
  const float cos_t = std::sqrt(1 - sin2_t);
  const float s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  const float p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return {std::min(0.5f * (sqr(s) + sqr(p)), 1.0f), cos_t};
}

// A conductor of complex index eta + i k relative to the outside [Born, Wolf, section 14.2].
inline Color fresnel_conductor(float cos_i, const Color& eta, const Color& k) {
  const float cos2 = sqr(cos_i), sin2 = 1 - cos2;
  const Color t = eta.square() - k.square() - sin2;
  // Not 0, by which an index of 0 would divide at normal incidence.
  const Color a2_b2 = (t.square() + 4 * eta.square() * k.square()).sqrt().max(1e-12f);
  const Color a = (0.5f * (a2_b2 + t)).max(0).sqrt();
  const Color sum = a2_b2 + cos2, cross = 2 * cos_i * a;
  const Color s = (sum - cross) / (sum + cross);
  const Color sum_p = cos2 * a2_b2 + sqr(sin2), cross_p = cross * sin2;
  const Color p = s * (sum_p - cross_p) / (sum_p + cross_p);
  return (0.5f * (s + p)).max(0).min(1);
}

// 2 int_0^1 F(mu) mu dmu, the reflectance of the interface for diffuse light that comes from the
// side where eta = n(other side) / n(this side) [Walsh 1926; the closed form for eta > 1]. The
// other side follows from the reciprocity of refraction: (1 - F(eta)) = eta^2 (1 - F(1 / eta)).
inline float fresnel_diffuse_reflectance(float eta) {
  if (eta < 1) return 1 - (1 - fresnel_diffuse_reflectance(1 / eta)) * sqr(eta);
  const double m = eta, m2 = m * m, m4 = m2 * m2, n2 = m2 + 1;
  if (m < 1 + 1e-3) return 0;  // below 1e-6; the closed form is 0/0 at 1
  const double value = 0.5 + (m - 1) * (3 * m + 1) / (6 * (m + 1) * (m + 1)) +
                       m2 * (m2 - 1) * (m2 - 1) / (n2 * n2 * n2) * std::log((m - 1) / (m + 1)) -
                       2 * m * m2 * (m2 + 2 * m - 1) / ((m2 + 1) * (m4 - 1)) +
                       8 * m4 * (m4 + 1) / ((m2 + 1) * (m4 - 1) * (m4 - 1)) * std::log(m);
  return static_cast<float>(value);
}

// About the normal z.
inline Vec3 reflect(const Vec3& w) { return {-w.x(), -w.y(), w.z()}; }
// About any unit m.
inline Vec3 reflect(const Vec3& w, const Vec3& m) { return 2 * w.dot(m) * m - w; }
// w and m on the same side; eta and cos_t as above.
inline Vec3 refract(const Vec3& w, const Vec3& m, float eta, float cos_t) {
  const Vec3 t = (w.dot(m) / eta - cos_t) * m - w / eta;
  return t.normalized();
}

}  // namespace waylight
