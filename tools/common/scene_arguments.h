#pragma once
// The options of every tool that reads a scene.

#include <memory>
#include <string>
#include <vector>

#include "libguide/scene/scene.h"
#include "tools/common/cli.h"

namespace waylight {

struct SceneArguments {
  std::string path;
  std::vector<std::string> defines;  // "name=value"
  bool lenient = false;
  bool two_sided = false;
  bool ignore_media = false;
  std::vector<std::string> written;  // files that the tool writes besides its options' outputs
};

// SCENE, -D name=value (repeatable), --lenient, --two-sided.
void add_scene(CLI::App& app, SceneArguments& arguments);
// --ignore-media, for the tools that trace rays.
void add_ignore_media(CLI::App& app, SceneArguments& arguments);
// The same with the scene as the value of an option that need not be given.
void add_scene_option(CLI::App& app, SceneArguments& arguments, const char* name,
                      const char* description);

SceneDescription load_scene(const SceneArguments& arguments, const ToolRun& run);
// The scene for transport; warns of what was repaired or left out, media with
// --ignore-media among it.
std::unique_ptr<Scene> build_scene(SceneDescription description, const SceneArguments& arguments,
                                   const ToolRun& run);

}  // namespace waylight
