#include "libguide/scene/area_emitter.h"

#include "libguide/math/frame.h"
#include "libguide/math/warp.h"
#include "libguide/scene/cone.h"
#include "libguide/scene/mesh_prepare.h"
#include "libguide/scene/surface.h"

namespace waylight {
namespace {

using Vec3d = Eigen::Vector3d;

std::vector<float> triangle_areas(const TriangleMesh& mesh) {
  std::vector<float> areas;
  areas.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    areas.push_back(static_cast<float>(
        triangle_area(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]])));
  return areas;
}

// Uniform barycentric coordinates, of low distortion [Heitz 2019].
Vec2 square_to_triangle(Vec2 u) {
  if (u.y() > u.x()) {
    u.x() *= 0.5f;
    u.y() -= u.x();
  } else {
    u.y() *= 0.5f;
    u.x() -= u.y();
  }
  return u;
}

// Per steradian at `from`, of a density `pdf_area` at a point whose normal faces it with cosine.
float area_to_solid_angle(float pdf_area, float distance2, float cosine) {
  const float density = pdf_area * distance2 / cosine;
  return std::isfinite(density) ? density : 0.0f;
}

// The direction to a point chosen with density pdf_area; none from behind.
std::optional<LightSample> towards(const Vec3& from, const SurfacePoint& point, float pdf_area,
                                   const Texture& radiance) {
  const Vec3 d = point.p - from;
  const float distance2 = d.squaredNorm(), distance = std::sqrt(distance2);
  const Vec3 wi = d / distance;
  const float cosine = -wi.dot(point.ng);
  if (!(cosine > 0)) return std::nullopt;
  const float density = area_to_solid_angle(pdf_area, distance2, cosine);
  if (density <= 0) return std::nullopt;
  return LightSample{wi, distance, radiance.eval(point.uv), density};
}

// Cosine-distributed over the emitting side: Le cos / (pdf_area cos / pi).
EmissionSample leave(const SurfacePoint& point, float area, const Texture& radiance,
                     const Vec2& u_direction) {
  const Vec3 local = square_to_cosine_hemisphere(u_direction);
  const Vec3 direction = Frame(point.ng).to_world(local).normalized();
  return {{offset_origin(point, point.ng), direction}, radiance.eval(point.uv) * (kPi * area)};
}

}  // namespace

MeshEmitter::MeshEmitter(const TriangleMesh& mesh, const Texture& radiance)
    : mesh_(&mesh),
      radiance_(&radiance),
      triangles_(triangle_areas(mesh)),
      area_(static_cast<float>(triangles_.total())),
      power_(kPi * triangles_.total() * mean(radiance.mean())) {}

SurfacePoint MeshEmitter::point(float u, const Vec2& u2) const {
  SurfacePoint result;
  const Vec2 b = square_to_triangle(u2);
  locate_on_triangle(*mesh_, triangles_.sample(u).index, b.x(), b.y(), result);
  return result;
}

std::optional<LightSample> MeshEmitter::sample(const Vec3& from, float u, const Vec2& u2) const {
  return towards(from, point(u, u2), 1 / area_, *radiance_);
}

float MeshEmitter::pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const {
  const float cosine = -wi.dot(on_light.ng);
  if (!(cosine > 0)) return 0;
  return area_to_solid_angle(1 / area_, (on_light.p - from).squaredNorm(), cosine);
}

std::optional<EmissionSample> MeshEmitter::emit(float u, const Vec2& u_position,
                                                const Vec2& u_direction) const {
  return leave(point(u, u_position), area_, *radiance_, u_direction);
}

SphereEmitter::SphereEmitter(const Sphere& sphere, bool flip, const Texture& radiance)
    : sphere_(&sphere),
      radiance_(&radiance),
      flip_(flip),
      area_(4 * kPi * sphere.radius * sphere.radius),
      power_(static_cast<double>(kPi) * area_ * mean(radiance.mean())) {}

// 1 - cos of the half angle in which the sphere is seen from outside; none from inside.
std::optional<float> SphereEmitter::cone_height(const Vec3& from) const {
  const double d2 = (sphere_->center.cast<double>() - from.cast<double>()).squaredNorm();
  const double sin2 = static_cast<double>(sphere_->radius) * sphere_->radius / d2;
  if (!(sin2 < 1)) return std::nullopt;
  return static_cast<float>(sin2 / (1 + std::sqrt(1 - sin2)));
}

LightSample SphereEmitter::sample_cone(const Vec3& from, float height, const Vec2& u2) const {
  const Vec3d axis = sphere_->center.cast<double>() - from.cast<double>();
  const Frame frame(axis.normalized().cast<float>());
  const Vec3 wi = frame.to_world(square_to_cone_of_height(u2, height)).normalized();
  double near, far;
  const Vec3d direction = wi.cast<double>();
  if (!intersect_sphere(*sphere_, from.cast<double>(), direction, near, far))
    near = axis.dot(direction);  // a tangent that rounding put beside the sphere
  SurfacePoint point;
  locate_on_sphere(*sphere_, flip_, near * direction - axis, point);
  return {wi, static_cast<float>(near), radiance_->eval(point.uv), cone_of_height_pdf(height)};
}

std::optional<LightSample> SphereEmitter::sample(const Vec3& from, float /*u*/,
                                                 const Vec2& u2) const {
  if (const std::optional<float> height = cone_height(from)) {
    if (flip_) return std::nullopt;
    return sample_cone(from, *height, u2);
  }
  SurfacePoint point;
  locate_on_sphere(*sphere_, flip_, square_to_sphere(u2).cast<double>(), point);
  return towards(from, point, 1 / area_, *radiance_);
}

float SphereEmitter::pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const {
  const float cosine = -wi.dot(on_light.ng);
  if (!(cosine > 0)) return 0;
  if (const std::optional<float> height = cone_height(from))
    return flip_ ? 0.0f : cone_of_height_pdf(*height);
  return area_to_solid_angle(1 / area_, (on_light.p - from).squaredNorm(), cosine);
}

std::optional<EmissionSample> SphereEmitter::emit(float /*u*/, const Vec2& u_position,
                                                  const Vec2& u_direction) const {
  SurfacePoint point;
  locate_on_sphere(*sphere_, flip_, square_to_sphere(u_position).cast<double>(), point);
  return leave(point, area_, *radiance_, u_direction);
}

}  // namespace waylight
