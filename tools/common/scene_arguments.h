#pragma once
// The options of every tool that reads a scene.

#include <string>
#include <vector>

#include "libguide/scene/scene.h"
#include "tools/common/cli.h"

namespace waylight {

struct SceneArguments {
  std::string path;
  std::vector<std::string> defines;  // "name=value"
  bool lenient = false;
};

// SCENE, -D name=value (repeatable), --lenient.
void add_scene(CLI::App& app, SceneArguments& arguments);
// The same with the scene as the value of an option that need not be given.
void add_scene_option(CLI::App& app, SceneArguments& arguments, const char* name,
                      const char* description);

SceneDescription load_scene(const SceneArguments& arguments, const ToolRun& run);
// Says what building the scene repaired or left out.
void warn_of_repairs(const Scene& scene, const ToolRun& run);

}  // namespace waylight
