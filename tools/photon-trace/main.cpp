// photon-trace: light particles of a scene, stored where they meet surfaces.

#include <CLI/CLI.hpp>

#include "tools/photon-trace/photon_trace_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "photon-trace", "Traces light particles and stores them where they hit surfaces",
    "SCENE -o scene.photons [--count N] [--seed S] [--pass I]",
    R"(Particles leave the emitters in proportion to their power and scatter at every BSDF, mirrors and
glass too. Each hit of a surface that is not purely specular is one photon: where, from which
direction, how much power, after how many scatterings. `cache-train` learns from them.

With --from camera the particles are importons: they carry importance from the camera over the whole
film, and are stored where they hit emitters too. `cache-train` makes an importance cache of them.
With --importance, photons follow such a cache from the emitters to where the camera sees.

Equal scene, count, seed and pass give equal bytes at any number of threads. Passes of the same seed
are independent of each other.

Examples:
  photon-trace room.xml -o room.photons --count 4000000
  photon-trace room.xml -o room.importons --from camera --count 1000000
  photon-trace room.xml -o room.photons --importance room.importance.cache
  photon-trace room.xml -o - --count 100000000 | cache-train --photons - -o room.cache)"};

void declare(CLI::App& app, PhotonTraceArguments& arguments) {
  PhotonTraceOptions& options = arguments.options;
  add_scene(app, arguments.scene);
  add_ignore_media(app, arguments.scene);
  as_output(
      app.add_option("-o,--output", arguments.output, "Photon file; - is the standard output"))
      ->required();
  add_choice(
      app, "--from", {"lights", "camera"},
      [&options](size_t i) {
        options.quantity = i == 0 ? Quantity::radiance : Quantity::importance;
      },
      "Photons of the emitters, or importons of the camera");
  as_input(app.add_option("--importance", arguments.importance,
                          "Importance cache that guides the photons"));
  app.add_option("--count", options.count, "Particles to emit")
      ->check(CLI::Range(1ull, 4000000000ull));
  app.add_option("--seed", options.seed, "Seed of the random numbers");
  app.add_option("--pass", options.pass,
                 "Number of the pass: other random numbers of the same seed");
  app.add_option("--max-depth", options.max_depth, "Most scattering events of one particle")
      ->check(CLI::Range(1, 10000));
  app.add_option("--rr-depth", options.rr_depth, "Scattering events before Russian roulette begins")
      ->check(CLI::Range(0, 10000));
}

}  // namespace

int main(int argc, char** argv) {
  PhotonTraceArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { photon_trace(run, kTool, arguments); });
}
