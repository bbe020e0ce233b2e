#include "libguide/scene/delta_emitter.h"

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/scene/cone.h"

namespace waylight {
namespace {

std::optional<LightSample> from_position(const Vec3& from, const Vec3& light,
                                         const Color& intensity) {
  const Vec3 d = light - from;
  const float distance = d.norm();
  const Color irradiance = intensity / sqr(distance);
  if (!is_finite(irradiance) || !(distance > 0)) return std::nullopt;
  return LightSample{d / distance, distance, irradiance, 1, true};
}

}  // namespace

Ray enter_scene(const SceneSphere& sphere, const Vec3& direction, const Vec2& u_position) {
  const Frame frame(direction);
  const Vec2 disk = square_to_disk(u_position);
  const Vec3 offset = disk.x() * frame.s + disk.y() * frame.t - direction;
  return {sphere.center + sphere.radius * offset, direction};
}

std::optional<LightSample> PointEmitter::sample(const Vec3& from, float /*u*/,
                                                const Vec2& /*u2*/) const {
  return from_position(from, light.position, light.intensity);
}

std::optional<EmissionSample> PointEmitter::emit(float /*u*/, const Vec2& /*u_position*/,
                                                 const Vec2& u_direction) const {
  return EmissionSample{{light.position, square_to_sphere(u_direction)},
                        light.intensity / kSpherePdf};
}

float SpotEmitter::falloff(float cos_angle) const {
  if (cos_angle >= std::cos(light.beam_width)) return 1;
  if (cos_angle <= std::cos(light.cutoff)) return 0;
  return (light.cutoff - std::acos(cos_angle)) / (light.cutoff - light.beam_width);
}

// 2 pi int falloff sin = 2 pi (1 - (sin c - sin b) / (c - b)), with c the cutoff, b the beam width.
double SpotEmitter::power() const {
  const double c = light.cutoff, b = light.beam_width;
  const double slope = c - b > 1e-6 ? (std::sin(c) - std::sin(b)) / (c - b) : std::cos(c);
  return 2 * kPi * (1 - slope) * mean(light.intensity);
}

std::optional<LightSample> SpotEmitter::sample(const Vec3& from, float /*u*/,
                                               const Vec2& /*u2*/) const {
  std::optional<LightSample> result = from_position(from, light.position, light.intensity);
  if (!result) return result;
  const float share = falloff(-result->wi.dot(light.direction));
  if (share <= 0) return std::nullopt;
  result->radiance *= share;
  return result;
}

std::optional<EmissionSample> SpotEmitter::emit(float /*u*/, const Vec2& /*u_position*/,
                                                const Vec2& u_direction) const {
  const float height = 2 * sqr(std::sin(0.5f * light.cutoff));
  const Vec3 local = square_to_cone_of_height(u_direction, height);
  const Vec3 direction = Frame(light.direction).to_world(local).normalized();
  return EmissionSample{{light.position, direction},
                        light.intensity * (falloff(local.z()) / cone_of_height_pdf(height))};
}

std::optional<LightSample> DirectionalEmitter::sample(const Vec3& /*from*/, float /*u*/,
                                                      const Vec2& /*u2*/) const {
  return LightSample{-light.direction, kInfinity, light.irradiance, 1, true};
}

std::optional<EmissionSample> DirectionalEmitter::emit(float /*u*/, const Vec2& u_position,
                                                       const Vec2& /*u_direction*/) const {
  return EmissionSample{enter_scene(sphere, light.direction, u_position),
                        light.irradiance * sphere.cross_section()};
}

}  // namespace waylight
