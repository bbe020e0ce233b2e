// brdf-fit: Gaussian mixtures of a scene's BSDFs.

#include <CLI/CLI.hpp>

#include "tools/brdf-fit/brdf_fit_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "brdf-fit", "Fits Gaussian mixtures to the BSDFs of a scene",
    "SCENE -o scene.brdf [--tolerance E] [--family-file FILE]...\n"
    "       brdf-fit --family NAME -o family.brdf",
    R"(For each material that has a density, and for a series of outgoing directions, a mixture on the
equal-area disk is fitted to the BSDF: by weighted maximum-a-posteriori EM, refined by least squares on
relative errors with Ceres; the better of the two is kept, with no more components than it needs. As many directions are fitted as keep the error between them
within --tolerance of the error at them, and materials whose lobes have one shape share theirs: of
diffuse materials one mixture serves all. Where the roughness is textured there are fits for a series
of widths, and the renderer takes that nearest to the local one; whatever else is textured is fitted
at its mean: guiding takes the shape of a lobe only, so the image stays unbiased. Mirrors and smooth
glass are sampled exactly by the renderer and need no fit.

A family is fitted once, for widths from 0.005 to 1, and serves the lobes of any scene that it fits
as well as its own: roughconductor-ggx, roughconductor-beckmann, phong, ward.

The errors are held-out ones: the mean |f - G| of both normalised densities over directions that
neither a fit nor a choice has seen, in [0, 2].

Examples:
  brdf-fit room.xml -o room.brdf
  brdf-fit --family roughconductor-ggx -o ggx.brdf
  brdf-fit room.xml --family-file ggx.brdf -o room.brdf
  cache-reduce room.brdf -o reduced.brdf)"};

void declare(CLI::App& app, BrdfFitArguments& arguments) {
  BrdfFitOptions& options = arguments.options;
  add_scene(app, arguments.scene);
  add_family(app, arguments);
  as_output(app.add_option("-o,--output", arguments.output, "File of fits to write"))->required();
  app.add_option("--tolerance", options.tolerance, "Error allowed between entries")
      ->check(CLI::Range(0.0f, 2.0f));
  app.add_option("--elevations", options.elevations, "Most entries of an isotropic material")
      ->check(CLI::Range(1, 4096));
  app.add_option("--directions", options.directions, "Most entries of an anisotropic material")
      ->check(CLI::Range(1, 65536));
  add_choice(
      app, "--fit", {"best", "em", "ceres"}, [&](size_t i) { options.method = FitMethod(i); },
      "How mixtures are fitted: EM, EM refined with Ceres, or the better of both");
  app.add_option("--components", options.components,
                 "Most components of a mixture; more than 8 are merged after the fit")
      ->check(CLI::Range(1, 16));
  app.add_flag("--fixed-components", options.fixed_components,
               "Keep as many, also where fewer do nearly as well");
  app.add_option("--samples", options.samples, "BSDF samples per fit")
      ->check(CLI::Range(16, 65536));
  app.add_option("--seed", options.seed, "Seed of the random numbers");
  as_output(
      app.add_option("--report", arguments.report, "Table over entries to write: errors, times"),
      {".csv"});
}

}  // namespace

int main(int argc, char** argv) {
  BrdfFitArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { brdf_fit(run, kTool, arguments); });
}
