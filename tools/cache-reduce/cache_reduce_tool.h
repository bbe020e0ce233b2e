#pragma once

#include <string>

#include "libguide/cache_reduce.h"
#include "tools/common/cli.h"

namespace waylight {

struct CacheReduceArguments {
  std::string input, output;
  CacheReduceOptions options;
};

void cache_reduce(const ToolRun& run, const ToolInfo& tool, const CacheReduceArguments& arguments);

}  // namespace waylight
