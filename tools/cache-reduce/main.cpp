// cache-reduce: fewer components per mixture.

#include <CLI/CLI.hpp>

#include "tools/cache-reduce/cache_reduce_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "cache-reduce", "Merges components of the mixtures in a .brdf or .cache file",
    "IN -o OUT [--max-cost PERCENT] [--auto] [--max-components K]",
    R"(The pair of components whose merge loses least, by Runnalls' bound of the Kullback-Leibler
divergence, is merged until the accumulated cost reaches --max-cost percent of what collapsing the
mixture to one component would cost. Fewer components make product sampling cheaper. Lobes of media
are merged in the same way.

With --auto a cache keeps as many components as the photons of each cell give evidence of: a merge
has to lose less log-likelihood than its parameters are worth (Akaike's information criterion).

A reduced cache cannot be trained further: keep the file it came from.

Examples:
  cache-reduce room.cache -o reduced.cache
  cache-reduce room.brdf -o reduced.brdf --max-cost 5)"};

void declare(CLI::App& app, CacheReduceArguments& arguments) {
  as_input(app.add_option("IN", arguments.input, "File of fits (.brdf) or cache (.cache)"))
      ->required();
  as_output(app.add_option("-o,--output", arguments.output, "File to write, of the same kind"))
      ->required();
  CLI::Option* max_cost =
      app.add_option("--max-cost", arguments.options.max_cost,
                     "Percent of the cost of collapsing a mixture to one component");
  app.add_flag("--auto", arguments.options.by_evidence,
               "Of a cache, merge what its photons cannot tell apart, instead; not of fits")
      ->excludes(max_cost);
  app.add_option("--max-components", arguments.options.max_components,
                 "Merge on until a mixture has no more than these")
      ->check(CLI::Range(1, 8));
}

}  // namespace

int main(int argc, char** argv) {
  CacheReduceArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { cache_reduce(run, kTool, arguments); });
}
