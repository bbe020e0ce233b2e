// What the path loop makes of Embree's own rate: the rays of a render, traced by the path tracer,
// by the scene's queries, and by Embree alone. One thread; items are rays.

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "common/small_scenes.h"
#include "libguide/scene/camera.h"
#include "libguide/transport/path_tracer.h"

namespace waylight {
namespace {

constexpr int kWidth = 96, kHeight = 64;

TriangleMesh tessellated_sphere(const Vec3& center, float radius, uint32_t rings) {
  TriangleMesh mesh;
  const uint32_t spokes = 2 * rings;
  for (uint32_t i = 0; i <= rings; ++i)
    for (uint32_t j = 0; j < spokes; ++j) {
      const float theta = kPi * i / rings, phi = 2 * kPi * j / spokes;
      const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta));
      mesh.positions.push_back(center + radius * n);
      mesh.normals.push_back(n);
    }
  for (uint32_t i = 0; i < rings; ++i)
    for (uint32_t j = 0; j < spokes; ++j) {
      const uint32_t a = i * spokes + j, b = i * spokes + (j + 1) % spokes;
      if (i > 0) mesh.triangles.push_back({a, a + spokes, b});
      if (i + 1 < rings) mesh.triangles.push_back({b, a + spokes, b + spokes});
    }
  return mesh;
}

// The box with a gap and a sphere of 130 000 triangles in it.
const Scene& scene() {
  static const Scene made([] {
    SceneDescription scene = testing::gap_box(kWidth, kHeight);
    testing::add_shape(scene, tessellated_sphere({0.3f, -0.5f, -0.1f}, 0.45f, 256), 1);
    return scene;
  }());
  return made;
}

const PathTracer& tracer() {
  static const GuidingCaches none;
  static const PathTracer made = [] {
    PathTracerOptions options;
    options.max_depth = 10;
    return PathTracer(scene(), none, options);
  }();
  return made;
}

Ray camera_ray(int pixel, Sampler& sampler) {
  static const Camera camera(scene().description().sensor);
  const Vec2 offset = sampler.next_2d();
  return camera.ray(Vec2(pixel % kWidth, pixel / kWidth) + offset, sampler.next_2d());
}

// The rays of paths that choose as the path tracer does, roulette apart.
struct Rays {
  struct Shadow {
    SurfacePoint from;
    LightSample light;
  };
  std::vector<Ray> nearest;
  std::vector<Shadow> shadow;
  std::vector<Ray> shadow_rays;  // the same for Embree

  Rays() {
    for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
      Sampler sampler(0, pixel, 0);
      follow(camera_ray(pixel, sampler), sampler);
    }
  }

 private:
  void follow(Ray ray, Sampler& sampler) {
    static const GuidingCaches none;
    for (int edge = 0; edge < 5; ++edge) {
      nearest.push_back(ray);
      const std::optional<SurfacePoint> at = scene().intersect(ray);
      if (!at) return;
      const DirectionSampler directions(scene(), none, {}, *at, -ray.direction);
      add_shadow(*at, directions, sampler);
      const std::optional<DirectionSample> next = directions.sample(sampler);
      if (!next) return;
      ray = scene().spawn_ray(*at, next->wi);
    }
  }
  void add_shadow(const SurfacePoint& at, const DirectionSampler& directions, Sampler& sampler) {
    const float u = sampler.next();
    const std::optional<LightSample> light = scene().sample_light(at.p, u, sampler.next_2d());
    if (!light || is_black(directions.eval(light->wi))) return;
    shadow.push_back({at, *light});
    shadow_rays.push_back(scene().spawn_ray(at, light->wi));
    shadow_rays.back().t_max = light->distance * (1 - 1e-4f);
  }
};

const Rays& rays() {
  static const Rays made;
  return made;
}

// The same triangles in an Embree scene of the benchmark's own.
class BareEmbree {
 public:
  BareEmbree() : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    for (const Shape& shape : scene().description().shapes)
      add(std::get<TriangleMesh>(shape.geometry));
    rtcCommitScene(scene_);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  bool intersect(const Ray& ray) const {
    RTCRayHit query;
    query.ray = embree_ray(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  bool occluded(const Ray& ray) const {
    RTCRay query = embree_ray(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0;
  }

 private:
  void add(const TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3), mesh.positions.size());
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3*>(positions));
    using Triangle = std::array<uint32_t, 3>;
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(Triangle), mesh.triangles.size());
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }
  static RTCRay embree_ray(const Ray& ray) {
    RTCRay r;
    r.org_x = ray.origin.x(), r.org_y = ray.origin.y(), r.org_z = ray.origin.z();
    r.dir_x = ray.direction.x(), r.dir_y = ray.direction.y(), r.dir_z = ray.direction.z();
    r.tnear = 0, r.tfar = ray.t_max, r.time = 0;
    r.mask = ~0u, r.id = 0, r.flags = 0;
    return r;
  }

  RTCDevice device_;
  RTCScene scene_;
};

void rays_path_loop(benchmark::State& state) {
  size_t count = 0;
  uint32_t pass = 0;
  for (auto _ : state) {
    for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
      Sampler sampler(0, pixel, pass);
      count += tracer().trace(camera_ray(pixel, sampler), sampler).rays;
    }
    ++pass;
  }
  state.SetItemsProcessed(static_cast<int64_t>(count));
}
BENCHMARK(rays_path_loop)->Unit(benchmark::kMillisecond);

void rays_scene(benchmark::State& state) {
  for (auto _ : state) {
    for (const Ray& ray : rays().nearest) benchmark::DoNotOptimize(scene().intersect(ray));
    for (const Rays::Shadow& s : rays().shadow)
      benchmark::DoNotOptimize(scene().visibility(s.from, s.light.wi, s.light.distance));
  }
  state.SetItemsProcessed(state.iterations() * (rays().nearest.size() + rays().shadow.size()));
}
BENCHMARK(rays_scene)->Unit(benchmark::kMillisecond);

void rays_embree(benchmark::State& state) {
  const BareEmbree embree;
  for (auto _ : state) {
    for (const Ray& ray : rays().nearest) benchmark::DoNotOptimize(embree.intersect(ray));
    for (const Ray& ray : rays().shadow_rays) benchmark::DoNotOptimize(embree.occluded(ray));
  }
  state.SetItemsProcessed(state.iterations() * (rays().nearest.size() + rays().shadow.size()));
}
BENCHMARK(rays_embree)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace waylight
