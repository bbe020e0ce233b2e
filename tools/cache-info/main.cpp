// cache-info: what a file of Waylight is, where it comes from, and what is in it.

#include <CLI/CLI.hpp>

#include "tools/cache-info/cache_info_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "cache-info", "Says what a file is, where it comes from and what is in it",
    "FILE [--json] [--check] [--plot CELL|X,Y,Z|MATERIAL -o lobe.png]",
    R"(FILE is any file of the pipeline: fitted BSDFs, photons, an illumination cache, an image. It is
known by its content, not by its name.

--plot draws one lobe on the equal-area disk, the upper hemisphere inside the ring: of a cell of an
illumination cache, given by its number, the mixture and with --samples the photons it saw beside it;
of a material, given by its name or number, the fit and with --scene the true BSDF beside it. Of the
cell of a medium at X,Y,Z it draws the sphere about +z, indirect light on the left and direct light
on the right, each relative to its largest density, and with --truth what arrives there beside both
kinds together. Colours are logarithmic, from a ten thousandth of
the largest value up.

Examples:
  cache-info room.cache
  cache-info room.photons --check
  cache-info room.cache --plot 17 --samples room.photons -o lobe.png
  cache-info fog.cache --plot 0.5,1,2 --samples fog.photons -o lobe.png
  render fog.xml --sphere 0.5,1,2 --size 256x256 --spp 256 -o sphere.exr
  cache-info fog.cache --plot 0.5,1,2 --truth sphere.exr -o lobe.png
  cache-info room.brdf --plot floor --elevation 60 --scene room.xml -o lobe.png)"};

}  // namespace

int main(int argc, char** argv) {
  CacheInfoArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { cache_info(run, arguments); });
}
