#pragma once

#include "libguide/brdf_fit.h"
#include "tools/common/scene_arguments.h"

namespace waylight {

struct BrdfFitArguments {
  SceneArguments scene;
  std::string output;
  BrdfFitOptions options;
};

void brdf_fit(const ToolRun& run, const ToolInfo& tool, const BrdfFitArguments& arguments);

}  // namespace waylight
