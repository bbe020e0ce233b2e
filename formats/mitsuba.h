#pragma once
// Import of Mitsuba scenes, dialects 0.4-0.6 and 2/3.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "libguide/scene/scene_description.h"

namespace waylight {

struct ImportOptions {
  std::map<std::string, std::string> defines;  // -D name=value
  bool lenient = false;    // unknown materials become grey diffuse, unknown shapes nothing
  bool two_sided = false;  // opaque materials of one side that shapes use get two
  std::function<void(const std::string&)> on_warning;
  std::function<void(const std::string&)> on_file;  // of each file that the scene refers to
};

// Throws Error naming file, line and element. Relative paths are looked for beside the file that
// names them, then beside the main scene file, then in the folders of its <path> elements.
SceneDescription import_mitsuba(const std::string& path, const ImportOptions& options);

}  // namespace waylight
