// render: the image, by path tracing with or without guiding.

#include <CLI/CLI.hpp>

#include "tools/render/render_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "render", "Renders a scene, guided by caches or not",
    "SCENE -o out.exr [--mode auto|bsdf|illumination|mixture|product|ris] [--spp N | --time S | "
    "--error E]",
    R"(Modes. bsdf: path tracing with next-event estimation. illumination: directions come from the BSDF
and from the cache of where light arrives (--cache). product: from the BSDF and the product of that
and the fitted BSDF (--cache and --brdf); mixture: from the mean of the two instead. ris: of
--candidates from BSDF and cache, the one that BSDF times light favours. auto: of what the caches that
are given make possible, what a small render before finds to pay. All have the same mean; caches
change the noise alone.

In media, --distance says where along a ray a path scatters and --direction whereto; all modes but
bsdf guide both where the cache holds media, and --mode bsdf --distance guided --direction product
--cache room.cache guides in media alone.

Distances in media. standard: by extinction. guided: by the light along the ray (--cache).
probability: the guide decides only whether a path scatters (--cache). equiangular: near lights, in
homogeneous media. exponential: by extinction times --distance-bias. The last three are there to be
compared with guided.

The render ends at the first of --spp, --time and --error (relMSE, as estimated from the image's own
variance); without any it takes 64 samples per pixel. Ctrl-C writes what there is.

Channels of --aov: albedo, normal, depth, samples, variance (of each pixel's mean), path_length,
guiding (share of scatterings with a guide), all.

Examples:
  render room.xml -o plain.exr --spp 256
  render room.xml -o guided.exr --mode product --cache room.cache --brdf room.brdf --time 60)"};

}  // namespace

int main(int argc, char** argv) {
  RenderArguments arguments;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, arguments); },
      [&](ToolRun& run) { render(run, kTool, arguments); });
}
