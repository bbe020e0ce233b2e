#pragma once
// Spheres as Embree's user geometry. Its own spheres are tested in float, which far from the origin
// or for a large sphere puts the hit off the surface by more than p_error.

#include <embree3/rtcore.h>

#include "libguide/scene/scene_description.h"

namespace waylight {

// Keeps a pointer to the sphere. Only single rays (rtcIntersect1, rtcOccluded1) are served.
RTCGeometry new_embree_sphere(RTCDevice device, const Sphere& sphere);

}  // namespace waylight
