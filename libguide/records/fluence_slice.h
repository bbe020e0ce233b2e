#pragma once

namespace waylight {

// A plane across the media of a scene, and what of it is shown.
struct FluenceSlice {
  int axis = 2;           // of the world that the plane is perpendicular to: x, y, z
  float position = 0;     // along it, in units of the scene
  bool of_cache = false;  // what the cells of a cache hold, instead of the truth by path tracing
};

}  // namespace waylight
