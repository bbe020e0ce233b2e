#include "libguide/scene/scene.h"

#include "libguide/scene/accelerator.h"
#include "libguide/scene/light_set.h"
#include "libguide/scene/placement.h"
#include "libguide/scene/scene_check.h"
#include "libguide/scene/surface.h"

namespace waylight {
namespace {

std::vector<bool> transparent_materials(const std::vector<Material>& materials) {
  std::vector<bool> result;
  for (int i = 0; i < static_cast<int>(materials.size()); ++i)
    result.push_back(may_be_transparent(materials, i));
  return result;
}

// Of a light's distance: what a shadow ray leaves out at its far end.
constexpr float kShadowMargin = 1e-4f;
constexpr int kMaxCrossings = 1000;

}  // namespace

struct Scene::Impl {
  std::vector<std::string> warnings;
  std::vector<bool> placed;
  std::vector<Placement> placements;
  std::unique_ptr<Accelerator> accelerator;
  LightSet lights;

  SurfacePoint surface_point(const SceneDescription& scene, const Ray& ray, const Hit& hit) const;
  std::optional<SurfacePoint> intersect(const SceneDescription& scene, const Ray& ray,
                                        RayMask mask) const;
};

SurfacePoint Scene::Impl::surface_point(const SceneDescription& scene, const Ray& ray,
                                        const Hit& hit) const {
  const Placement* placement = hit.instance == kNone ? nullptr : &placements[hit.instance];
  const Shape& shape = (placement ? scene.group_shapes : scene.shapes)[hit.shape];
  SurfacePoint point;
  if (placement) point.p_error = placement->local_error(ray(hit.t));
  if (const TriangleMesh* mesh = std::get_if<TriangleMesh>(&shape.geometry)) {
    locate_on_triangle(*mesh, hit.primitive, hit.u, hit.v, point);
    shade_triangle(*mesh, hit.primitive, hit.u, hit.v, point);
  } else {
    const Sphere& sphere = std::get<Sphere>(shape.geometry);
    const Eigen::Vector3d o = placement ? placement->local_origin(ray) : ray.origin.cast<double>();
    const Eigen::Vector3d d =
        placement ? placement->local_direction(ray) : ray.direction.cast<double>();
    locate_on_sphere(sphere, shape.flip_normals, o + hit.t * d - sphere.center.cast<double>(),
                     point);
    shade_sphere(sphere, point);
  }
  if (placement) placement->to_world(point);
  point.t = hit.t;
  point.material = shape.material;
  point.emitter = shape.emitter;
  point.interior_medium = shape.interior_medium;
  point.exterior_medium = shape.exterior_medium;
  point.shape = hit.shape;
  return point;
}

std::optional<SurfacePoint> Scene::Impl::intersect(const SceneDescription& scene, const Ray& ray,
                                                   RayMask mask) const {
  const std::optional<Hit> hit = accelerator->intersect(ray, mask);
  if (!hit) return std::nullopt;
  return surface_point(scene, ray, *hit);
}

Scene::Scene(SceneDescription description)
    : description_(std::move(description)), impl_(std::make_unique<Impl>()) {
  impl_->warnings = prepare_scene(description_);
  impl_->placed = placed_instances(description_, impl_->warnings);
  bounds_ = scene_bounds(description_, impl_->placed);
  for (const Instance& instance : description_.instances)
    impl_->placements.emplace_back(instance.to_world);
  impl_->accelerator = std::make_unique<Accelerator>(
      description_, transparent_materials(description_.materials), impl_->placed);
  impl_->lights = LightSet(description_, SceneSphere(bounds_));
}

Scene::~Scene() = default;

const std::vector<std::string>& Scene::build_warnings() const { return impl_->warnings; }

std::optional<SurfacePoint> Scene::intersect(const Ray& ray) const {
  return impl_->intersect(description_, ray, kEverything);
}

Ray Scene::spawn_ray(const SurfacePoint& from, const Vec3& direction) const {
  return {offset_origin(from, direction), direction};
}

namespace {

// From the surface to just before the target; empty when rounding cannot tell the two apart.
std::optional<Ray> shadow_ray(const SurfacePoint& from, const Vec3& wi, float distance) {
  const Vec3 origin = offset_origin(from, wi);
  if (distance == kInfinity) return Ray{origin, wi};
  const Vec3 target = from.p + distance * wi;
  const Vec3 d = target - origin;
  const float length = d.norm();
  const float rounding = 4 * kRounding * target.cwiseAbs().maxCoeff();
  const float reach = (1 - kShadowMargin) * length - rounding;
  if (!(reach > 0)) return std::nullopt;
  return Ray{origin, d / length, reach};
}

}  // namespace

float Scene::visibility(const SurfacePoint& from, const Vec3& wi, float distance) const {
  std::optional<Ray> ray = shadow_ray(from, wi, distance);
  if (!ray) return 1;
  if (impl_->accelerator->occluded(*ray, kOpaque)) return 0;
  if (!impl_->accelerator->has_transparent()) return 1;
  float share = 1;
  for (int crossing = 0; crossing < kMaxCrossings && ray; ++crossing) {
    const std::optional<SurfacePoint> at = impl_->intersect(description_, *ray, kTransparent);
    if (!at) return share;
    share *= 1 - opacity(*at);
    if (share <= 0) return 0;
    const float left = ray->t_max - at->t;
    ray = Ray{offset_origin(*at, ray->direction), ray->direction, left};
  }
  return 0;
}

ResolvedBsdf Scene::bsdf(const SurfacePoint& at, const Vec3& wo, TransportMode mode) const {
  if (at.material == kNone) return {{}, Frame(at.ns)};
  return resolve(description_.materials, at.material, {at.uv, at.ng, at.ns, at.dpdu, at.dpdv}, wo,
                 mode);
}

float Scene::opacity(const SurfacePoint& at) const {
  if (at.material == kNone) return 1;
  return waylight::opacity(description_.materials, at.material, at.uv);
}

Color Scene::emitted(const SurfacePoint& at, const Vec3& wo) const {
  if (at.emitter == kNone || at.ng.dot(wo) <= 0) return Color::Zero();
  return std::get<AreaLight>(description_.emitters[at.emitter]).radiance.eval(at.uv);
}

Color Scene::environment(const Vec3& direction) const {
  return impl_->lights.environment(direction);
}

std::optional<LightSample> Scene::sample_light(const Vec3& from, float u, const Vec2& u2) const {
  return impl_->lights.sample(from, u, u2);
}

float Scene::light_pdf(const Vec3& from, const SurfacePoint& on_light, const Vec3& wi) const {
  return impl_->lights.pdf(from, on_light, wi);
}

float Scene::environment_pdf(const Vec3& wi) const { return impl_->lights.environment_pdf(wi); }

std::optional<EmissionSample> Scene::sample_emission(float u, const Vec2& u_position,
                                                     const Vec2& u_direction) const {
  return impl_->lights.emit(u, u_position, u_direction);
}

std::optional<EmissionSample> Scene::emit(int emitter, float u, const Vec2& u_position,
                                          const Vec2& u_direction) const {
  return impl_->lights.emit(emitter, u, u_position, u_direction);
}

float Scene::emission_prob(int emitter) const { return impl_->lights.emission_prob(emitter); }

bool Scene::has_lights() const { return !impl_->lights.empty(); }

bool Scene::has_distant_light() const { return impl_->lights.has_distant(); }

}  // namespace waylight
