#pragma once

#include <variant>

#include "libguide/scene/scene.h"

namespace waylight {

// A vertex in a medium.
struct MediumPoint : RayOrigin {
  float t = 0;  // distance from the vertex before
  const MediumTracker* medium = nullptr;
  int index = kNone;  // of the medium
  Color albedo = Color::Zero();
};

// Where an edge of a path ends; nowhere: it left the scene.
using PathVertex = std::variant<std::monostate, SurfacePoint, MediumPoint>;

// The medium of a ray that leaves a vertex.
inline int medium_after(const SurfacePoint& at, const Vec3& wi, int current) {
  return medium_beyond(at, wi, current);
}
inline int medium_after(const MediumPoint& /*at*/, const Vec3& /*wi*/, int current) {
  return current;
}

inline bool in_grid(const SurfacePoint& /*at*/) { return false; }
inline bool in_grid(const MediumPoint& at) { return !at.medium->homogeneous(); }

// Where a flight along `ray` scattered. crossed: length of the edge before the ray's origin.
inline MediumPoint medium_point(const MediumTracker& medium, int index, const Ray& ray,
                                const Flight& flight, float crossed) {
  MediumPoint at;
  at.p = ray(flight.t);
  at.t = crossed + flight.t;
  at.medium = &medium;
  at.index = index;
  at.albedo = flight.here.albedo;
  return at;
}

}  // namespace waylight
