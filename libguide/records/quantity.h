#pragma once

#include <cstdint>

namespace waylight {

// What particles carry and a cache holds: radiance from the emitters, carried by photons, or
// importance from the camera, carried by importons. The two are adjoint: the mean of the image is
// the integral of emitted radiance times importance over the emitters.
enum class Quantity : uint8_t { radiance, importance };

inline const char* quantity_name(Quantity q) {
  return q == Quantity::radiance ? "radiance" : "importance";
}

}  // namespace waylight
