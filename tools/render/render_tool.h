#pragma once

#include "libguide/render.h"
#include "tools/common/scene_arguments.h"

namespace waylight {

struct RenderArguments {
  SceneArguments scene;
  std::string output, png, cache, brdf, segments;
  std::string size, crop;  // WxH; X,Y,W,H
  std::string bsdf_share = "auto";
  std::vector<std::string> aovs;  // names
  RenderOptions options;
};

void add_mode(CLI::App& app, RenderMode& mode);  // --mode
// --rr, --split, --pixel-estimate, --max-depth, --rr-depth
void add_media(CLI::App& app, RenderOptions& options);
void add_roulette(CLI::App& app, RenderOptions& options);
void add_stopping(CLI::App& app, RenderOptions& options);     // --spp, --time, --error
void add_sharing(CLI::App& app, RenderArguments& arguments);  // --bsdf-share, --candidates
void add_frame(CLI::App& app, RenderArguments& frame);        // --size, --crop, --aov

void render(const ToolRun& run, const ToolInfo& tool, const RenderArguments& arguments);

}  // namespace waylight
