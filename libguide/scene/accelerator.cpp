#include "libguide/scene/accelerator.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include "libguide/base/error.h"
#include "libguide/scene/embree_sphere.h"

namespace waylight {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

// Exceptions must not cross Embree: the first message is kept and thrown afterwards.
struct ErrorLog {
  std::string first;

  static void report(void* self, RTCError /*code*/, const char* message) {
    std::string& first = static_cast<ErrorLog*>(self)->first;
    if (first.empty()) first = message ? message : "unknown error";
  }
  void check() const {
    if (!first.empty()) fail("embree: {}; the scene may be too large for the memory", first);
  }
};

// One thread: the builder's partitions depend on the number of threads, and with them which of two
// surfaces at the same distance is hit. Bytes must not.
void commit_serially(RTCScene scene) {
  tbb::task_arena arena(1);
  arena.execute([scene] { rtcJoinCommitScene(scene); });
}

EmbreeScene new_scene(RTCDevice device) {
  EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  return scene;
}

// Positions are copied: Embree reads 16 bytes at each, and pads a vertex buffer of its own.
RTCGeometry new_mesh(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const size_t count = mesh.positions.size();
  auto* to = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                        RTC_FORMAT_FLOAT3, sizeof(Vec3), count));
  if (to) std::copy(mesh.positions.begin(), mesh.positions.end(), to);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(mesh.triangles[0]),
                             mesh.triangles.size());
  return geometry;
}

RTCRayHit make_ray(const Ray& ray, RayMask mask) {
  RTCRayHit query;
  query.ray = {ray.origin.x(),
               ray.origin.y(),
               ray.origin.z(),
               0,
               ray.direction.x(),
               ray.direction.y(),
               ray.direction.z(),
               0,
               ray.t_max,
               mask,
               0,
               0};
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct Accelerator::Handles {
  ErrorLog log;
  Device device;
  std::vector<EmbreeScene> groups;
  std::vector<RayMask> group_masks;
  EmbreeScene top;

  void attach(RTCScene scene, RTCGeometry geometry, RayMask mask, uint32_t id) {
    rtcSetGeometryMask(geometry, mask);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
    log.check();
  }
  RayMask attach_shape(RTCScene scene, const Shape& shape, const std::vector<bool>& transparent,
                       uint32_t id);
  void add_group(const SceneDescription& scene, const ShapeGroup& group,
                 const std::vector<bool>& transparent);
  void add_instance(const Instance& instance, uint32_t id);
};

RayMask Accelerator::Handles::attach_shape(RTCScene scene, const Shape& shape,
                                           const std::vector<bool>& transparent, uint32_t id) {
  const RayMask mask =
      shape.material != kNone && transparent[shape.material] ? kTransparent : kOpaque;
  const TriangleMesh* mesh = std::get_if<TriangleMesh>(&shape.geometry);
  if (mesh && mesh->triangles.empty()) return mask;
  attach(scene,
         mesh ? new_mesh(device.get(), *mesh)
              : new_embree_sphere(device.get(), std::get<Sphere>(shape.geometry)),
         mask, id);
  return mask;
}

void Accelerator::Handles::add_group(const SceneDescription& scene, const ShapeGroup& group,
                                     const std::vector<bool>& transparent) {
  groups.push_back(new_scene(device.get()));
  uint32_t mask = 0;
  for (uint32_t i = 0; i < group.shapes.size(); ++i)
    mask |= attach_shape(groups.back().get(), scene.group_shapes[group.shapes[i]], transparent, i);
  group_masks.push_back(static_cast<RayMask>(mask));
  commit_serially(groups.back().get());
  log.check();
}

void Accelerator::Handles::add_instance(const Instance& instance, uint32_t id) {
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, groups[instance.group].get());
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, instance.to_world.data());
  attach(top.get(), geometry, group_masks[instance.group], id);
}

Accelerator::Accelerator(const SceneDescription& scene, const std::vector<bool>& transparent,
                         const std::vector<bool>& placed)
    : scene_(scene), handles_(std::make_unique<Handles>()) {
  Handles& h = *handles_;
  h.device.reset(rtcNewDevice(nullptr));
  if (!h.device) fail("embree: no device; this processor may lack SSE4.2");
  rtcSetDeviceErrorFunction(h.device.get(), ErrorLog::report, &h.log);
  h.top = new_scene(h.device.get());
  uint32_t seen = 0;
  for (uint32_t i = 0; i < scene.shapes.size(); ++i)
    seen |= h.attach_shape(h.top.get(), scene.shapes[i], transparent, i);
  for (const ShapeGroup& group : scene.groups) h.add_group(scene, group, transparent);
  for (uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (!placed[i]) continue;
    h.add_instance(scene.instances[i], static_cast<uint32_t>(scene.shapes.size()) + i);
    seen |= h.group_masks[scene.instances[i].group];
  }
  commit_serially(h.top.get());
  h.log.check();
  has_transparent_ = seen & kTransparent;
}

Accelerator::~Accelerator() = default;

std::optional<Hit> Accelerator::intersect(const Ray& ray, RayMask mask) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = make_ray(ray, mask);
  rtcIntersect1(handles_->top.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit{query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID, query.hit.geomID};
  if (query.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.instance = static_cast<int>(query.hit.instID[0] - scene_.shapes.size());
  hit.shape = scene_.groups[scene_.instances[hit.instance].group].shapes[query.hit.geomID];
  return hit;
}

bool Accelerator::occluded(const Ray& ray, RayMask mask) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = make_ray(ray, mask);
  rtcOccluded1(handles_->top.get(), &context, &query.ray);
  return query.ray.tfar < 0;
}

}  // namespace waylight
