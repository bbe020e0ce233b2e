#include <CLI/CLI.hpp>

#include "tools/photon-trace/photon_trace_tool.h"

namespace waylight {

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
  app.add_option("--count", options.count, "Particles to emit; 0 beside --paths: none")
      ->check(CLI::Range(0ull, 4000000000ull));
  app.add_option("--paths", options.paths,
                 "Camera paths that carry radiance back, beside the photons")
      ->check(CLI::Range(0ull, 4000000000ull));
  as_input(app.add_option("--cache", arguments.cache,
                          "Cache of the pass before that guides the camera paths"));
  add_seed(app, options.seed);
  app.add_option("--pass", options.pass,
                 "Number of the pass: other random numbers of the same seed");
  app.add_option("--max-depth", options.max_depth, "Most scattering events of one particle or path")
      ->check(CLI::Range(1, 10000));
  app.add_option("--rr-depth", options.rr_depth, "Scattering events before Russian roulette begins")
      ->check(CLI::Range(0, 10000));
}

}  // namespace waylight
