// chart: lines over the columns of tables.

#include <CLI/CLI.hpp>

#include "tools/chart/chart_tool.h"
#include "tools/common/cli.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "chart", "Draws tables of figures: error over time, one line per method",
    "TABLES.csv... -o OUT.svg",
    R"(Tables are those of `image-compare --csv`, or any with a heading: --x, --y and --lines name columns.
Rows of one line and x (several seeds) become one point, their mean, and a band from the smallest to
the largest. The dashed line has slope -1: the squared error of an unbiased method falls along it with
the time of rendering. Rows that logarithmic axes cannot show are left out with a warning.
Tables of `render --segments` become the share of the luminance over the number of path edges.

Examples:
  chart room.csv -o room.svg --title "Room" --preprocess
  chart room.csv -o memory.svg --y memory_bytes --bars
  chart bsdf.csv product.csv -o segments.svg
  chart reduction.csv -o reduction.svg --x cache_components --y relmse --linear x)"};

void declare(CLI::App& app, ChartOptions& options) {
  as_input(app.add_option("TABLES", options.tables, "Tables with a heading (.csv)"))->required();
  as_output(app.add_option("-o,--output", options.output, "Chart to write (.svg)"), {".svg"})
      ->required();
  app.add_option("--title", options.title, "Title of the chart");
  app.add_option("--x", options.x, "Column of the horizontal axis")->type_name("COLUMN");
  app.add_option("--y", options.y, "Column of the vertical axis")->type_name("COLUMN");
  app.add_option("--lines", options.lines, "Column that tells the lines apart")
      ->type_name("COLUMN");
  app.add_option("--linear", options.linear, "Axes that are not logarithmic")->type_name("x|y|xy");
  app.add_option("--labels", options.labels, "Column of words to write beside the points")
      ->type_name("COLUMN");
  app.add_option("--default", options.standard, "Label of the default, which gets a ring")
      ->type_name("LABEL");
  app.add_flag("--bars", options.bars, "One bar per line: the vertical axis at its largest x");
  app.add_flag("--preprocess", options.preprocess, "Add preprocess_seconds to the seconds");
  app.add_flag("--png", options.png, "Write a PNG of the same name too");
}

}  // namespace

int main(int argc, char** argv) {
  ChartOptions options;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, options); },
      [&](ToolRun& run) { chart(run, options); });
}
