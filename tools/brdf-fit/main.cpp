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

}  // namespace

int main(int argc, char** argv) {
  BrdfFitArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { brdf_fit(run, kTool, arguments); });
}
