#include <CLI/CLI.hpp>

#include "tools/brdf-fit/brdf_fit_tool.h"

namespace waylight {

void declare(CLI::App& app, BrdfFitArguments& arguments) {
  BrdfFitOptions& options = arguments.options;
  add_scene(app, arguments.scene);
  add_family(app, arguments);
  as_output(app.add_option("-o,--output", arguments.output, "File of fits to write"))->required();
  app.add_option("--tolerance", options.tolerance, "Error allowed between entries")
      ->check(CLI::Range(0.0f, 2.0f));
  app.add_option("--elevations", options.elevations, "Most entries of an isotropic material")
      ->check(CLI::Range(2, 4096));
  app.add_option("--directions", options.directions, "Most entries of an anisotropic material")
      ->check(CLI::Range(1, 65536));
  add_choice(
      app, "--fit", {"best", "em", "ceres"}, [&](size_t i) { options.method = FitMethod(i); },
      "How mixtures are fitted: the better of both, EM, or EM refined with Ceres");
  app.add_option("--components", options.components,
                 "Most components of a mixture; more than 8 are merged after the fit")
      ->check(CLI::Range(1, 16));
  app.add_flag("--fixed-components", options.fixed_components,
               "Keep as many, also where fewer do nearly as well");
  app.add_option("--samples", options.samples, "BSDF samples per fit")
      ->check(CLI::Range(16, 65536));
  add_seed(app, options.seed);
  as_output(
      app.add_option("--report", arguments.report, "Table over entries to write: errors, times"),
      {".csv"});
}

}  // namespace waylight
