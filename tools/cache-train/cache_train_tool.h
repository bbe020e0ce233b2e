#pragma once

#include "libguide/cache_train.h"
#include "tools/common/cli.h"

namespace waylight {

struct CacheTrainArguments {
  std::string photons, previous, output;
  CacheTrainOptions options;
  bool once = false;  // photons are not read again
};

void declare(CLI::App& app, CacheTrainArguments& arguments);

void cache_train(const ToolRun& run, const ToolInfo& tool, const CacheTrainArguments& arguments);

}  // namespace waylight
