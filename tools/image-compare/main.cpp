// image-compare: how far an image is from its reference.

#include <CLI/CLI.hpp>

#include "tools/common/cli.h"
#include "tools/image-compare/compare_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "image-compare", "Says how far an image is from its reference",
    "IMAGE REFERENCE [--csv TABLE] [--error-image PICTURE] [--z self|VARIANCE]",
    R"(relMSE is the mean over pixels and channels of (x - ref)^2 / (ref^2 + 0.01); the trimmed figure
leaves out the worst 0.1 % of the pixels. With --z, the distribution of z-scores per pixel and per tile
tells noise from bias: `self` uses the variance channels of `render --aov variance`.

Examples:
  image-compare guided.exr reference.exr --error-image error.png
  image-compare guided.exr plain.exr --z self
  image-compare guided.exr reference.exr --render-stats guided.json --csv room.csv)"};

}  // namespace

int main(int argc, char** argv) {
  ImageCompareOptions options;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, options); },
      [&](ToolRun& run) { image_compare(run, options); });
}
