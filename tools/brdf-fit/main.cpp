// brdf-fit: Gaussian mixtures of a scene's BSDFs.

#include <CLI/CLI.hpp>

#include "tools/brdf-fit/brdf_fit_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "brdf-fit", "Fits Gaussian mixtures to the BSDFs of a scene",
    "SCENE -o scene.brdf [--elevations N] [--components K] [--samples N]",
    R"(For each material that has a density, and for a series of elevations of the outgoing direction, a
mixture on the equal-area disk is fitted to the BSDF by weighted maximum-a-posteriori EM. Mirrors and
smooth glass are sampled exactly by the renderer and need no fit. A textured material is fitted at its
mean parameters: guiding takes the shape of its lobe only, so the image stays unbiased.

The held-out error is the mean |f - G| of both normalised densities over directions that the fit did
not see, in [0, 2].

Example:
  brdf-fit room.xml -o room.brdf
  cache-reduce room.brdf -o reduced.brdf)"};

void declare(CLI::App& app, BrdfFitArguments& arguments) {
  BrdfFitOptions& options = arguments.options;
  add_scene(app, arguments.scene);
  as_output(app.add_option("-o,--output", arguments.output, "File of fits to write"))->required();
  app.add_option("--elevations", options.elevations, "Outgoing directions per material")
      ->check(CLI::Range(1, 4096));
  app.add_option("--components", options.components, "Components of a mixture")
      ->check(CLI::Range(1, 8));
  app.add_option("--samples", options.samples, "BSDF samples per fit")
      ->check(CLI::Range(16, 65536));
  app.add_option("--seed", options.seed, "Seed of the random numbers");
}

}  // namespace

int main(int argc, char** argv) {
  BrdfFitArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { brdf_fit(run, kTool, arguments); });
}
