#pragma once

#include <cstdint>

namespace waylight {

// Content hashes of the parts of a scene that a cache depends on. The camera is not among them.
struct SceneHash {
  uint64_t geometry = 0, materials = 0, emitters = 0, media = 0;
  bool operator==(const SceneHash&) const = default;
};

}  // namespace waylight
