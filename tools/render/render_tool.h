#pragma once

#include "libguide/render.h"
#include "tools/common/scene_arguments.h"

namespace waylight {

struct RenderArguments {
  SceneArguments scene;
  std::string output, png, cache, brdf, segments;
  std::string size, crop;  // WxH; X,Y,W,H
  std::string bsdf_share = "auto";
  std::string fluence;  // AXIS=POSITION; empty: the camera's view
  bool fluence_of_cache = false;
  std::string sphere;  // X,Y,Z; empty: the camera's view
  std::vector<std::string> aovs;  // names
  RenderOptions options;
};

void declare(CLI::App& app, RenderArguments& arguments);  // its command line

void render(const ToolRun& run, const ToolInfo& tool, const RenderArguments& arguments);

}  // namespace waylight
