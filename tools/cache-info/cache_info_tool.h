#pragma once

#include <string>

#include "tools/cache-info/lobe_plot.h"

namespace waylight {

struct CacheInfoArguments {
  std::string file;
  bool json = false, check = false;
  LobePlotArguments plot;
};

void declare(CLI::App& app, CacheInfoArguments& arguments);  // its command line

void cache_info(const ToolRun& run, const CacheInfoArguments& arguments);

}  // namespace waylight
