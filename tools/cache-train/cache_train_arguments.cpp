#include <CLI/CLI.hpp>

#include "tools/cache-train/cache_train_tool.h"

namespace waylight {

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
  app.add_flag("--once", arguments.once,
               "Read the photons once: mixtures of surfaces stay as they were learned on the way");
  add_choice(
      app, "--direct", {"drop", "keep"},
      [&options](size_t i) { options.direct = i == 0 ? DirectLight::drop : DirectLight::keep; },
      "Photons straight from an emitter, which next-event estimation finds too, and importons "
      "straight from the camera, which photons cannot hit");
}

}  // namespace waylight
