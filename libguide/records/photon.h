#pragma once

#include <cstdint>
#include <vector>

#include "libguide/math/types.h"

namespace waylight {

// A light particle at the moment it hits a surface that is not purely specular.
struct Photon {
  Vec3 position;
  Vec3 direction;  // unit, away from the surface: where the light comes from (wi)
  Vec3 normal;     // unit shading normal on the side the photon arrives from
  Color power;     // W; the sum over all photons on an area estimates its flux
  uint32_t path_depth = 0;  // scattering events since emission; 0 is direct light
};

// How many particles and photons, and how the particles ended.
struct PhotonCounts {
  uint64_t emitted = 0, stored = 0;
  uint64_t left_scene = 0, absorbed = 0, too_deep = 0;
  uint64_t invalid = 0;  // photons dropped for a NaN or infinite power or place

  PhotonCounts& operator+=(const PhotonCounts& other) {
    emitted += other.emitted;
    stored += other.stored;
    left_scene += other.left_scene;
    absorbed += other.absorbed;
    too_deep += other.too_deep;
    invalid += other.invalid;
    return *this;
  }
};

// What a stream of photons says of itself, before the first photon.
struct PhotonStreamInfo {
  Bounds scene_bounds;
  uint64_t emitted = 0;  // particles emitted for the whole stream; powers are divided by it already
  uint32_t pass = 0;
};

}  // namespace waylight
