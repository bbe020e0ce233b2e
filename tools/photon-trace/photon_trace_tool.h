#pragma once

#include "libguide/photon_trace.h"
#include "tools/common/scene_arguments.h"

namespace waylight {

struct PhotonTraceArguments {
  SceneArguments scene;
  std::string output, importance, cache;
  PhotonTraceOptions options;
};

void declare(CLI::App& app, PhotonTraceArguments& arguments);  // its command line

void photon_trace(const ToolRun& run, const ToolInfo& tool, const PhotonTraceArguments& arguments);

}  // namespace waylight
