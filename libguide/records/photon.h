#pragma once

#include <cstdint>
#include <vector>

#include "libguide/math/types.h"
#include "libguide/records/quantity.h"

namespace waylight {

// A particle at the moment it hits a surface that is not purely specular; an importon also where it
// hits an emitter.
struct Photon {
  Vec3 position;
  Vec3 direction;  // unit, away from the surface: where the light comes from (wi)
  Vec3 normal;     // unit shading normal on the side the photon arrives from
  // Photons: W; the sum over all of an area estimates its flux. Importons: no unit; the sum of
  // power times emitted radiance over all that hit emitters estimates the mean of the image.
  Color power;
  // Scattering events since emission; 0 is direct light. That of media counts from 1: next-event
  // estimation does not find it.
  uint32_t path_depth = 0;
};

// An importon that left the scene towards distant emitters.
struct Escape {
  Vec3 origin;     // a point of the ray, where it left the last surface
  Vec3 direction;  // unit, the way it went: to the light
  Color power;     // as of importons
  uint32_t path_depth = 0;
};

// A particle in a medium: one sample of the fluence along one of its flights. The sum of weights
// over all in a region estimates the integral of the fluence over its volume.
struct MediumPhoton {
  Vec3 position;
  Vec3 direction;  // unit, where the light comes from: against the flight
  Color weight;    // W m
  uint32_t path_depth = 0;  // scattering events since emission; 0 is direct light
};

// How many particles and photons, and how the particles ended.
struct PhotonCounts {
  uint64_t emitted = 0, stored = 0;
  uint64_t left_scene = 0, absorbed = 0, too_deep = 0;
  uint64_t invalid = 0;  // photons dropped for a NaN or infinite power or place
  uint64_t escapes = 0;  // stored beside the photons
  uint64_t in_media = 0;  // photons of media, stored beside those of surfaces

  PhotonCounts& operator+=(const PhotonCounts& other) {
    emitted += other.emitted;
    stored += other.stored;
    left_scene += other.left_scene;
    absorbed += other.absorbed;
    too_deep += other.too_deep;
    invalid += other.invalid;
    escapes += other.escapes;
    in_media += other.in_media;
    return *this;
  }
};

// What particles left behind.
struct PhotonRecords {
  std::vector<Photon> photons;
  std::vector<Escape> escapes;
  std::vector<MediumPhoton> in_media;
  PhotonCounts counts;
};

// What a stream of photons says of itself, before the first photon.
struct PhotonStreamInfo {
  Bounds scene_bounds;
  uint64_t emitted = 0;  // particles emitted for the whole stream; powers are divided by it already
  uint32_t pass = 0;
  Quantity quantity = Quantity::radiance;
  bool media = false;  // the scene has media, and the stream may hold photons in them
};

}  // namespace waylight
