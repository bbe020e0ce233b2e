#pragma once

#include "libguide/cache_train.h"
#include "tools/common/cli.h"

namespace waylight {

struct CacheTrainArguments {
  std::string photons, previous, output;
  CacheTrainOptions options;
};

void cache_train(const ToolRun& run, const ToolInfo& tool, const CacheTrainArguments& arguments);

}  // namespace waylight
