#pragma once

#include "libguide/brdf_fit.h"
#include "tools/common/scene_arguments.h"

namespace waylight {

struct BrdfFitArguments {
  SceneArguments scene;               // or
  std::string family;                 // name
  std::vector<std::string> families;  // files of families that may serve the scene
  std::string output;
  std::string report;  // table over entries; empty: none
  BrdfFitOptions options;
};

void declare(CLI::App& app, BrdfFitArguments& arguments);  // its command line
// --family in place of SCENE, --family-file
void add_family(CLI::App& app, BrdfFitArguments& arguments);

void brdf_fit(const ToolRun& run, const ToolInfo& tool, const BrdfFitArguments& arguments);

}  // namespace waylight
