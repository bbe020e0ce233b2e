#pragma once

#include <string>

#include "libguide/medium/cloud.h"
#include "tools/common/cli.h"

namespace waylight {

struct MakeCloudArguments {
  std::string output;
  CloudOptions options;
};

void make_cloud(const ToolRun& run, const ToolInfo& tool, const MakeCloudArguments& arguments);

}  // namespace waylight
