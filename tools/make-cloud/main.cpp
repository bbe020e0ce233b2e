// make-cloud: a procedural cloud as an OpenVDB grid.

#include <CLI/CLI.hpp>

#include "tools/make-cloud/make_cloud_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "make-cloud", "Makes a cumulus cloud as an OpenVDB grid",
    "-o OUT.vdb [--resolution N] [--puffs N] [--coverage C] [--billows B] [--edge W] [--seed S]",
    R"(Writes a float grid `density`, 0 to 1, in the box [-1, 1] x [-0.6, 0.6] x [-0.75, 0.75] with y
up. Most of the box is empty, and stored as such; the rim is as hard as --edge is narrow. A scene
scales the density to an extinction and places the grid:

  <medium type="heterogeneous" id="cloud">
    <volume name="sigma_t" type="gridvolume"><string name="filename" value="cloud.vdb"/></volume>
    <float name="scale" value="40"/>
  </medium>

The same options give the same bytes.

Examples:
  make-cloud -o cloud.vdb
  make-cloud -o tower.vdb --puffs 3 --coverage 0.8 --seed 5
  make-cloud -o large.vdb --resolution 512 --edge 0.02)"};

void declare(CLI::App& app, MakeCloudArguments& arguments) {
  CloudOptions& options = arguments.options;
  as_output(app.add_option("-o,--output", arguments.output, "Grid to write"), {".vdb"})->required();
  app.add_option("--resolution", options.resolution, "Voxels along x, the longest side");
  app.add_option("--puffs", options.puffs, "Spheres that the cloud grows from");
  app.add_option("--coverage", options.coverage, "From a wisp, 0, to all of the box, 1");
  app.add_option("--billows", options.billows, "Depth of the creases between billows, 0 to 1");
  app.add_option("--edge", options.edge, "Width of the rim where density rises");
  add_seed(app, options.seed, "Of the shape");
}

}  // namespace

int main(int argc, char** argv) {
  MakeCloudArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { make_cloud(run, kTool, arguments); });
}
