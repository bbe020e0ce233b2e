// photon-trace: light particles of a scene, stored where they meet surfaces.

#include <CLI/CLI.hpp>

#include "tools/photon-trace/photon_trace_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "photon-trace", "Traces light particles and stores them where they hit surfaces",
    "SCENE -o scene.photons [--count N] [--paths N] [--seed S] [--pass I]",
    R"(Particles leave the emitters in proportion to their power and scatter at every BSDF, mirrors and
glass too. Each hit of a surface that is not purely specular is one photon: where, from which
direction, how much power, after how many scatterings. `cache-train` learns from them.

With --from camera the particles are importons: they carry importance from the camera over the whole
film, and are stored where they hit emitters too. `cache-train` makes an importance cache of them.
With --importance, photons follow such a cache from the emitters to where the camera sees.

With --paths, paths from the camera carry the radiance that they find back to where they scattered,
with next-event estimation on the way: each vertex leaves what one direction brings it. They go into
the same file, beside the photons or with --count 0 alone, and `cache-train` learns from both. They
know the light where photons are rare and the camera looks; photons know the light that is hard to
find. With --cache, paths are guided by what was learned before.

Equal scene, count, seed and pass give equal bytes at any number of threads. Passes of the same seed
are independent of each other.

Examples:
  photon-trace room.xml -o room.photons --count 4000000
  photon-trace room.xml -o room.importons --from camera --count 1000000
  photon-trace room.xml -o room.photons --importance room.importance.cache
  photon-trace room.xml -o room.photons --count 1000000 --paths 250000
  photon-trace room.xml -o room.photons --count 0 --paths 1000000 --cache room.cache
  photon-trace room.xml -o - --count 100000000 | cache-train --photons - -o room.cache)"};

}  // namespace

int main(int argc, char** argv) {
  PhotonTraceArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { photon_trace(run, kTool, arguments); });
}
