#pragma once
// Where a file comes from. Only what can change its bytes: no host, no date, no folder, no threads.

#include <cstdint>
#include <string>
#include <vector>

#include "libguide/records/scene_hash.h"

namespace waylight {

struct ParentFile {
  std::string name;   // without folders
  uint64_t hash = 0;  // of its content (XXH3)
};

struct Provenance {
  std::string tool, version, command_line;
  uint64_t seed = 0;
  std::string scene_name;  // file name without folders; empty when no scene was behind it
  SceneHash scene;
  std::vector<ParentFile> parents;
};

// XXH3 of a file's content.
uint64_t hash_file(const std::string& path);

// Throws Error when a cache was made for another scene, naming what differs (geometry, materials,
// emitters or media), the two scene names and the remedy. media and emitters may be left out where
// a cache does not depend on them (BRDF fits depend on materials alone).
enum class SceneParts { materials, all };
void require_same_scene(const std::string& path, const Provenance& provenance,
                        const std::string& scene_name, const SceneHash& scene, SceneParts parts);

}  // namespace waylight
