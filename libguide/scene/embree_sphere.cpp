#include "libguide/scene/embree_sphere.h"

#include "libguide/scene/surface.h"

namespace waylight {
namespace {

// A float box around the exact sphere.
void bounds(const RTCBoundsFunctionArguments* args) {
  const Sphere& s = *static_cast<const Sphere*>(args->geometryUserPtr);
  const Vec3 half =
      Vec3::Constant(s.radius) + 4 * kRounding * (s.center.cwiseAbs().array() + s.radius).matrix();
  const Vec3 low = s.center - half, high = s.center + half;
  *args->bounds_o = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

// Distance to the nearest crossing in (tnear, tfar), or a negative number.
float nearest(const Sphere& sphere, const RTCRay& ray) {
  double near, far;
  if (!intersect_sphere(sphere, {ray.org_x, ray.org_y, ray.org_z},
                        {ray.dir_x, ray.dir_y, ray.dir_z}, near, far))
    return -1;
  const double t = near > ray.tnear ? near : far;
  return t > ray.tnear && t < ray.tfar ? static_cast<float>(t) : -1.0f;
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  RTCRayHit& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const float t = nearest(*static_cast<const Sphere*>(args->geometryUserPtr), query.ray);
  if (t < 0) return;
  query.ray.tfar = t;
  query.hit.u = query.hit.v = 0;
  query.hit.primID = args->primID;
  query.hit.geomID = args->geomID;
  query.hit.instID[0] = args->context->instID[0];
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  RTCRay& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (nearest(*static_cast<const Sphere*>(args->geometryUserPtr), ray) >= 0) ray.tfar = -kInfinity;
}

}  // namespace

RTCGeometry new_embree_sphere(RTCDevice device, const Sphere& sphere) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<Sphere*>(&sphere));
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occluded);
  return geometry;
}

}  // namespace waylight
