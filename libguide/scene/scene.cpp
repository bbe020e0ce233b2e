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
    result.push_back(waylight::may_be_transparent(materials, i));
  return result;
}

// Whether rays that leave a scene see anything of an emitter.
struct Shines {
  bool operator()(const ConstantEnvironment& light) const { return !is_black(light.radiance); }
  bool operator()(const DistantDisk& light) const { return !is_black(light.radiance); }
  bool operator()(const EnvironmentMap& light) const {
    const auto& pixels = light.bitmap->pixels;
    return light.scale > 0 && !std::all_of(pixels.begin(), pixels.end(), is_black);
  }
  template <typename Other>
  bool operator()(const Other&) const {
    return false;
  }
};

// Of a light's distance: what a shadow ray leaves out at its far end.
constexpr float kShadowMargin = 1e-4f;

}  // namespace

struct Scene::Impl {
  std::vector<std::string> warnings;
  std::vector<bool> placed, transparent;  // transparent: of each material
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
  impl_->transparent = transparent_materials(description_.materials);
  impl_->accelerator =
      std::make_unique<Accelerator>(description_, impl_->transparent, impl_->placed);
  impl_->lights = LightSet(description_, SceneSphere(bounds_));
  for (const Medium& medium : description_.media) media_.emplace_back(medium);
}

Scene::~Scene() = default;

const std::vector<std::string>& Scene::build_warnings() const { return impl_->warnings; }

std::optional<SurfacePoint> Scene::intersect(const Ray& ray) const {
  return impl_->intersect(description_, ray, kEverything);
}

Ray Scene::spawn_ray(const RayOrigin& from, const Vec3& direction) const {
  return {offset_origin(from, direction), direction};
}

namespace {

// From the surface to just before the target; empty when rounding cannot tell the two apart.
std::optional<Ray> shadow_ray(const RayOrigin& from, const Vec3& wi, float distance) {
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

Color Scene::visibility(const RayOrigin& from, const Vec3& wi, float distance) const {
  return pass(from, kNone, wi, distance, nullptr);
}

Color Scene::transmittance(const RayOrigin& from, int medium, const Vec3& wi, float distance,
                           Sampler& path) const {
  if (!has_media()) return visibility(from, wi, distance);
  RandomStream random(path);
  return pass(from, medium, wi, distance, &random);
}

// random: null leaves media out. The margin at the far end is for surfaces; media fill it.
Color Scene::pass(const RayOrigin& from, int medium, const Vec3& wi, float distance,
                  RandomStream* random) const {
  std::optional<Ray> ray = shadow_ray(from, wi, distance);
  if (!ray) return Color::Ones();
  if (impl_->accelerator->occluded(*ray, kOpaque)) return Color::Zero();
  const float margin = distance == kInfinity ? 0.0f : std::max(distance - ray->t_max, 0.0f);
  const bool transparent = impl_->accelerator->has_transparent();
  Color share = Color::Ones();
  for (int crossing = 0; crossing < kMaxCrossings; ++crossing) {
    std::optional<SurfacePoint> at;
    if (transparent) at = impl_->intersect(description_, *ray, kTransparent);
    if (random && medium != kNone)
      share *= media_[medium].transmittance(*ray, at ? at->t : ray->t_max + margin, *random);
    if (!at) return share;
    share *= straight_transmission(*at, ray->direction);
    if (is_black(share)) return share;
    medium = medium_beyond(*at, ray->direction, medium);
    ray = Ray{offset_origin(*at, ray->direction), ray->direction, ray->t_max - at->t};
  }
  return Color::Zero();
}

// Of a surface that may be transparent.
Color Scene::straight_transmission(const SurfacePoint& at, const Vec3& direction) const {
  const float met = opacity(at);
  if (!(met > 0)) return Color::Ones();
  const ResolvedBsdf resolved = bsdf(at, -direction, TransportMode::radiance);
  return 1 - met + met * resolved.bsdf.straight_transmission(resolved.frame.to_local(-direction));
}

int Scene::medium_at(const Vec3& p) const {
  if (!has_media()) return kNone;
  Ray ray{p, Vec3(0.5377f, 0.7219f, 0.4356f).normalized()};
  for (int crossing = 0; crossing < kMaxCrossings; ++crossing) {
    const std::optional<SurfacePoint> at = intersect(ray);
    if (!at) return kNone;
    if (at->interior_medium != kNone || at->exterior_medium != kNone)
      return medium_beyond(*at, -ray.direction, kNone);
    ray = spawn_ray(*at, ray.direction);
  }
  return kNone;
}

ResolvedBsdf Scene::bsdf(const SurfacePoint& at, const Vec3& wo, TransportMode mode) const {
  if (at.material == kNone) return {{}, Frame(at.ns)};
  return resolve(description_.materials, at.material, {at.uv, at.ng, at.ns, at.dpdu, at.dpdv}, wo,
                 mode);
}

float Scene::opacity(const SurfacePoint& at) const {
  if (!may_be_transparent(at)) return 1;
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

bool Scene::may_be_transparent(const SurfacePoint& at) const {
  return at.material != kNone && impl_->transparent[at.material];
}

double Scene::emitter_power() const { return impl_->lights.power(); }

bool Scene::has_lights() const {
  const auto emits = [](const MediumTracker& medium) { return medium.emits(); };
  return !impl_->lights.empty() || std::any_of(media_.begin(), media_.end(), emits);
}

bool Scene::has_distant_light() const { return impl_->lights.has_distant(); }

bool Scene::has_environment() const {
  const auto& emitters = description().emitters;
  return std::any_of(emitters.begin(), emitters.end(), [](const EmitterDescription& emitter) {
    return std::visit(Shines(), emitter);
  });
}

}  // namespace waylight
