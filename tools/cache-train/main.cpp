// cache-train: illumination caches from photons.

#include <CLI/CLI.hpp>

#include "tools/cache-train/cache_train_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "cache-train", "Learns from photons where light comes from",
    "--photons FILE|- [--in PREVIOUS.cache] -o scene.cache",
    R"(A tree splits space, and surfaces that face different ways; each of its cells learns a Gaussian
mixture over the directions that light comes from, by stepwise EM, in one pass over the photons.
Memory grows with the cells and never with the photons. In media a tree splits space alone; its cells
learn the fluence and von Mises-Fisher lobes of direct and of indirect light.

Samples of camera paths (photon-trace --paths) teach a cell like photons, each kind by its evidence.

With --in, training goes on from a cache that was not reduced: photons of another pass refine it.

Examples:
  cache-train --photons room.photons -o room.cache
  cache-train --photons more.photons --in room.cache -o better.cache
  photon-trace room.xml -o - --count 100000000 | cache-train --photons - -o room.cache)"};

void declare(CLI::App& app, CacheTrainArguments& arguments) {
  CacheTrainOptions& options = arguments.options;
  as_input(app.add_option("--photons", arguments.photons, "Photon file; - is the standard input"))
      ->required();
  as_input(app.add_option("--in", arguments.previous, "Cache to go on from"));
  as_output(app.add_option("-o,--output", arguments.output, "Cache to write"))->required();
  app.add_option("--components", options.components, "Most components of a cell's mixture")
      ->check(CLI::Range(1, 8));
  app.add_option("--photons-per-cell", options.photons_per_cell, "A cell that saw more is split")
      ->check(CLI::Range(64, 10000000));
  app.add_option("--medium-photons-per-cell", options.medium_photons_per_cell,
                 "The same of a cell of a medium")
      ->check(CLI::Range(64, 10000000));
  app.add_option("--max-cells", options.max_cells,
                 "Bound of the cells of surfaces and of those of media, and so of memory")
      ->check(CLI::Range(1, 10000000));
  app.add_option("--normal-spread", options.normal_spread,
                 "A cell whose mean normal is shorter than this is split by orientation")
      ->check(CLI::Range(0.0, 1.0));
  app.add_flag("--auto", options.merge_alike,
               "As many cells as the light needs: siblings become one where their photons "
               "cannot tell their light apart");
  add_choice(
      app, "--direct", {"drop", "keep"},
      [&options](size_t i) { options.direct = i == 0 ? DirectLight::drop : DirectLight::keep; },
      "Photons straight from an emitter, which next-event estimation finds too, and importons "
      "straight from the camera, which photons cannot hit");
}

}  // namespace

int main(int argc, char** argv) {
  CacheTrainArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { cache_train(run, kTool, arguments); });
}
