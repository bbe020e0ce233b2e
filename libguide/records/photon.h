#pragma once

#include <cstdint>
#include <vector>

#include "libguide/math/types.h"
#include "libguide/records/quantity.h"

namespace waylight {

// Which end of a path a record of light was made from.
enum class TracedFrom : uint8_t { lights, camera };

// A particle at the moment it hits a surface that is not purely specular; an importon also where it
// hits an emitter. Or, traced from the camera, what a camera path found at one of its vertices: a
// sample of the irradiance there, Li cos / pdf of the direction, W/m^2. The mean of these over the
// vertices of a place is its irradiance; how many there are says where the camera looks, and
// nothing of the light. A vertex leaves one sample of indirect light on each side that it scatters
// from, also where that is dark, and up to two of direct light.
struct Photon {
  Vec3 position;
  Vec3 direction;  // unit, away from the surface: where the light comes from (wi)
  Vec3 normal;     // unit shading normal on the side the photon arrives from
  // Photons: W; the sum over all of an area estimates its flux. Importons: no unit; the sum of
  // power times emitted radiance over all that hit emitters estimates the mean of the image.
  Color power;
  // Scattering events since emission; 0 is direct light. That of media counts from 1: next-event
  // estimation does not find it. From the camera: 1 is all light that is not direct.
  uint32_t path_depth = 0;
  TracedFrom from = TracedFrom::lights;
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
  Vec3 direction;           // unit, where the light comes from: against the flight
  Color weight;             // W m
  uint32_t path_depth = 0;  // scattering events since emission; 0 is direct light
};

// How many particles and photons, and how the particles ended.
struct PhotonCounts {
  uint64_t emitted = 0, stored = 0;
  uint64_t left_scene = 0, absorbed = 0, too_deep = 0;
  uint64_t invalid = 0;   // photons dropped for a NaN or infinite power or place
  uint64_t escapes = 0;   // stored beside the photons
  uint64_t in_media = 0;  // photons of media, stored beside those of surfaces
  uint64_t paths = 0;     // camera paths that carry radiance back
  uint64_t samples = 0;   // of theirs, stored beside the photons

  PhotonCounts& operator+=(const PhotonCounts& other) {
    emitted += other.emitted;
    stored += other.stored;
    left_scene += other.left_scene;
    absorbed += other.absorbed;
    too_deep += other.too_deep;
    invalid += other.invalid;
    escapes += other.escapes;
    in_media += other.in_media;
    paths += other.paths;
    samples += other.samples;
    return *this;
  }
};

// What particles left behind.
struct PhotonRecords {
  std::vector<Photon> photons;
  std::vector<Escape> escapes;
  std::vector<MediumPhoton> in_media;
  PhotonCounts counts;

  void clear() {  // keeps the memory
    photons.clear(), escapes.clear(), in_media.clear();
    counts = {};
  }
};

// What a stream of photons says of itself, before the first photon.
struct PhotonStreamInfo {
  Bounds scene_bounds;
  uint64_t emitted = 0;  // particles emitted for the whole stream; powers are divided by it already
  uint32_t pass = 0;
  Quantity quantity = Quantity::radiance;
  bool media = false;  // the scene has media, and the stream may hold photons in them
  uint64_t paths = 0;  // camera paths whose samples stand beside the photons
  // Photons and samples that are to come, by a few of both traced before; 0: it is not known, as in
  // streams without camera paths.
  uint64_t expected = 0;
};

}  // namespace waylight
