#pragma once
// What the tests of trainings in media share: places of photons, and what their stream says.

#include "libguide/base/sampler.h"
#include "libguide/records/photon.h"

namespace waylight::testing {

// Evenly anywhere in a box.
inline Vec3 place_in(const Bounds& box, Sampler& sampler) {
  const Vec2 u = sampler.next_2d();
  const Vec3 place(u.x(), u.y(), sampler.next());
  return box.min + place.cwiseProduct(box.max - box.min);
}

inline PhotonStreamInfo fog_info(uint64_t emitted, const Bounds& bounds) {
  PhotonStreamInfo info;
  info.scene_bounds = bounds;
  info.emitted = emitted;
  info.media = true;
  return info;
}

}  // namespace waylight::testing
