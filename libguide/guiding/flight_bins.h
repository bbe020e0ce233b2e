#pragma once
// What a ray meets in a medium that a cache knows: bins of one extinction and one cell each.

#include <array>

#include "libguide/guiding/flight_space.h"
#include "libguide/math/lanes.h"

namespace waylight {

// In structure-of-arrays form, for lanes: entries up to the next multiple of kLanes have no length.
// Densities are factors of sigma: 1 in homogeneous media, else the block's mean extinction for a
// sigma of one. A depth is the integral of the density; times sigma_c, the optical depth of channel
// c.
struct FlightBins {
  static constexpr int kMax = 96;
  using Row = std::array<float, kMax>;

  // Where next to no light is left, bins are no longer told apart: the last one goes on to the end
  // of the ray.
  explicit FlightBins(const FlightSpace& space);

  int find(float t) const;  // the bin at a distance, or -1
  float depth_at(int i, float t) const { return depth[i] + density[i] * (t - start[i]); }

  int count = 0;
  Color sigma;
  float end_depth = 0;     // of the whole ray
  float end_radiance = 0;  // that the last cell sees along the ray
  // Not initialised: the first `count` are set.
  alignas(32) Row start, length, density;
  alignas(32) Row depth;   // before the bin
  alignas(32) Row source;  // albedo Li, Li the radiance scattered towards the ray's origin
  alignas(32) Row direct;  // the share of emitters in the light that the cell sees

 private:
  using Cells = std::array<uint32_t, kMax>;

  void lay_out(const FlightSpace& space, Cells& cells);
  void look_up(const FlightSpace& space, const Cells& cells);
  void pad();
};

}  // namespace waylight
