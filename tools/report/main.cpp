// report: what methods buy on scenes, as one page that opens anywhere.

#include "tools/common/cli.h"
#include "tools/report/report_tool.h"

using namespace waylight;

namespace {

constexpr ToolInfo kTool = {
    "report", "Shows methods on scenes side by side, as one self-contained page",
    "TABLES.csv... -o OUT.html",
    R"(Tables are those of `image-compare --csv`; they say where images, references and statistics are,
which may also be in the folder of their table. The page has charts, tables, images side by side, the
crop in which methods differ most, errors in false colours, and all parameters; nothing is loaded from
elsewhere.

"Time to reach" is when a method has the relMSE that the first method has at its end, on the straight
line between checkpoints (both axes logarithmic). ~ marks times beyond the checkpoints, along slope -1.

Examples:
  report room.csv -o room.html --title "Room"
  report room.csv rings.csv -o report.html --base bsdf --csv faster.csv
  report room.csv -o room.html --crop 120,40,64,36 --chart reduction.svg)"};

}  // namespace

int main(int argc, char** argv) {
  ReportOptions options;
  return run_tool(
      argc, argv, kTool, [&](CLI::App& app) { declare(app, options); },
      [&](ToolRun& run) { report(run, options); });
}
