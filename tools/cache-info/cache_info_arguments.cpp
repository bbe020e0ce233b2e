#include <CLI/CLI.hpp>

#include "tools/cache-info/cache_info_tool.h"

namespace waylight {

void declare(CLI::App& app, CacheInfoArguments& arguments) {
  as_input(app.add_option("FILE", arguments.file, "File to look into"))->required();
  app.add_flag("--json", arguments.json, "Print JSON");
  app.add_flag("--check", arguments.check, "Verify everything, and say only that it is sound");
  app.add_option("--plot", arguments.plot.target, "Cell, place in a medium or material to draw")
      ->type_name("CELL|X,Y,Z|MATERIAL");
  as_output(app.add_option("-o,--output", arguments.plot.output, "Picture to draw (.png)"),
            {".png"});
  as_input(app.add_option("--samples", arguments.plot.samples,
                          "Photon file whose photons are drawn beside the cell's mixture"));
  add_choice(
      app, "--direct", {"drop", "keep"}, [&arguments](size_t i) { arguments.plot.direct = i == 1; },
      "Of --samples: photons straight from an emitter, which cache-train drops unless told to "
      "keep");
  as_input(app.add_option("--truth", arguments.plot.truth,
                          "Picture of render --sphere=X,Y,Z that is drawn beside all light there"));
  app.add_option("--elevation", arguments.plot.elevation,
                 "Angle of wo from the normal of a material, in degrees")
      ->check(CLI::Range(0.0, 90.0));
  app.add_option("--size", arguments.plot.size, "Side of one disk, in pixels")
      ->check(CLI::Range(32, 4096));
  add_scene_option(app, arguments.plot.scene, "--scene",
                   "Scene whose BSDF is drawn beside the material's fit");
}

}  // namespace waylight
