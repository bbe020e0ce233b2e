#pragma once
// The folder of scenes made elsewhere, which tests use where it is there.

#include <cstdlib>
#include <filesystem>

namespace waylight::testing {

inline std::filesystem::path scenes_folder() {
  if (const char* folder = std::getenv("WAYLIGHT_SCENES")) return folder;
  return std::filesystem::path(WAYLIGHT_SOURCE_DIR) / ".." / "shared" / "scenes";
}

}  // namespace waylight::testing
