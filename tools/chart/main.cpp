// chart: error over time from the tables of image-compare.

#include <CLI/CLI.hpp>

#include "tools/chart/chart_tool.h"
#include "tools/common/cli.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "chart", "Draws error over time, log-log, one line per method", "TABLES.csv... -o OUT.svg",
    R"(Tables are those of `image-compare --csv`. Rows of one method and time (several seeds) become one
point, their geometric mean, and a band from the smallest to the largest. The dashed line has slope -1:
the error of an unbiased method falls along it.

Example:
  chart room.csv -o room.svg --title "Room" --preprocess)"};

void declare(CLI::App& app, ChartOptions& options) {
  as_input(app.add_option("TABLES", options.tables, "Tables that `image-compare --csv` wrote"))
      ->required();
  as_output(app.add_option("-o,--output", options.output, "Chart to write (.svg)"), {".svg"})
      ->required();
  app.add_option("--title", options.title, "Title of the chart");
  app.add_option("--x", options.x, "Column of the horizontal axis")->type_name("seconds|spp");
  app.add_option("--y", options.y, "Column of the vertical axis")
      ->type_name("relmse|mse|relmse_trimmed|mape");
  app.add_flag("--preprocess", options.preprocess, "Add preprocess_seconds to the seconds");
  app.add_flag("--png", options.png, "Write a PNG of the same name too");
}

}  // namespace

int main(int argc, char** argv) {
  ChartOptions options;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, options); },
      [&](ToolRun&) { chart(options); });
}
