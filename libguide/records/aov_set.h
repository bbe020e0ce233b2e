#pragma once

namespace waylight {

// Auxiliary outputs, as channels beside R, G, B.
struct AovSet {
  bool albedo = false;         // albedo.R/G/B of the first surface
  bool normal = false;         // normal.X/Y/Z, world space
  bool depth = false;          // depth.Z, distance along the camera ray
  bool sample_count = false;   // samples.N
  bool variance = false;       // variance.R/G/B of the mean
  bool path_length = false;    // path_length.N, mean number of path edges
  bool guiding_share = false;  // guiding.share, share of scattering events with a guide
};

}  // namespace waylight
