#include <CLI/CLI.hpp>

#include "tools/cache-info/cache_info_tool.h"

namespace waylight {
namespace {

// What is drawn beside the lobe, and how.
void declare_drawing(CLI::App& app, LobePlotArguments& plot) {
  as_input(app.add_option("--samples", plot.samples,
                          "Photon file whose photons are drawn beside the cell's mixture"));
  add_choice(
      app, "--direct", {"drop", "keep"}, [&plot](size_t i) { plot.direct = i == 1; },
      "Of --samples: photons straight from an emitter, which cache-train drops unless told to "
      "keep")
      ->needs("--samples");
  as_input(app.add_option("--truth", plot.truth,
                          "Picture of render --sphere=X,Y,Z that is drawn beside all light there"));
  app.add_option("--elevation", plot.elevation,
                 "Angle of wo from the normal of a material, in degrees")
      ->default_str("45");
  app.add_option("--size", plot.size, "Side of one disk, in pixels")->check(CLI::Range(32, 4096));
  add_scene_option(app, plot.scene, "--scene",
                   "Scene whose BSDF is drawn beside the material's fit");
}

}  // namespace

void declare(CLI::App& app, CacheInfoArguments& arguments) {
  as_input(app.add_option("FILE", arguments.file, "File to look into"))->required();
  CLI::Option* json = app.add_flag("--json", arguments.json, "Print JSON");
  CLI::Option* check =
      app.add_flag("--check", arguments.check, "Verify everything, and say only that it is sound");
  CLI::Option* plot =
      app.add_option("--plot", arguments.plot.target, "Cell, place in a medium or material to draw")
          ->type_name("CELL|X,Y,Z|MATERIAL")
          ->excludes(json)
          ->excludes(check);
  as_output(app.add_option("-o,--output", arguments.plot.output, "Picture to draw (.png)"),
            {".png"});
  declare_drawing(app, arguments.plot);
  for (const char* name : {"--samples", "--direct", "--truth", "--elevation", "--size", "--scene"})
    app.get_option(name)->needs(plot);
}

}  // namespace waylight
