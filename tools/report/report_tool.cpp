#include "tools/report/report_tool.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "libguide/base/error.h"
#include "tools/common/csv.h"
#include "tools/report/page.h"

namespace waylight {
namespace {

void print_row(const ToolRun& run, const Reach& r) {
  run.print(fmt::format("{:<16}{:<16}{:>10.3g}{:>10}{:>8.3g}{:>10.3g}{:>16.3g}{:>16.3g}", r.scene,
                        r.method, r.target,
                        fmt::format("{}{:.3g}", r.extrapolated ? "~" : "", r.seconds), r.ratio,
                        r.trimmed_ratio, r.preprocess_seconds, r.total_ratio));
}

void print_table(const ToolRun& run, const std::vector<Reach>& table) {
  run.print(fmt::format("{:<16}{:<16}{:>10}{:>10}{:>8}{:>10}{:>16}{:>16}", "scene", "method",
                        "relMSE", "seconds", "sooner", "trimmed", "preprocessing s",
                        "sooner with it"));
  for (const Reach& reach : table) print_row(run, reach);
}

CsvTable csv_of(const std::vector<Reach>& table) {
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  CsvTable csv;
  csv.columns = {"scene",
                 "method",
                 "relmse",
                 "seconds",
                 "low",
                 "high",
                 "preprocess_seconds",
                 "sooner",
                 "sooner_trimmed",
                 "sooner_with_preprocessing",
                 "extrapolated"};
  for (const Reach& r : table)
    csv.rows.push_back({r.scene, r.method, number(r.target), number(r.seconds), number(r.low),
                        number(r.high), number(r.preprocess_seconds), number(r.ratio),
                        number(r.trimmed_ratio), number(r.total_ratio),
                        r.extrapolated ? "yes" : "no"});
  return csv;
}

}  // namespace

void ReportOptions::validate() const {
  require(crop.empty() || crop.size() == 4, "--crop wants x,y,width,height");
  require(width >= 64 && width <= 4096, "--width {} is not in 64..4096", width);
}

void declare(CLI::App& app, ReportOptions& options) {
  as_input(app.add_option("TABLES", options.tables, "Tables of image-compare (.csv)"))->required();
  as_output(app.add_option("-o,--output", options.output, "Report to write (.html)"), {".html"})
      ->required();
  app.add_option("--title", options.title, "Title of the report");
  app.add_option("--base", options.base, "Method to compare with; else the first in the table")
      ->type_name("METHOD");
  as_output(app.add_option("--csv", options.csv, "Write the times to reach its error"), {".csv"});
  as_input(app.add_option("--chart", options.charts, "SVG to show at the end; repeatable"))
      ->allow_extra_args(false);
  as_input(app.add_option("--stability", options.stability,
                          "Table of pipelines/stability.mk to show at the end (.csv)"));
  app.add_option("--crop", options.crop, "Window to enlarge, in pixels")
      ->type_name("X,Y,W,H")
      ->delimiter(',')
      ->expected(4);
  app.add_option("--width", options.width, "Most pixels of a picture in a row");
  app.add_option("--exposure", options.exposure, "Stops by which pictures are brightened");
}

void report(const ToolRun& run, const ReportOptions& options) {
  options.validate();
  const std::vector<SceneRuns> scenes = read_runs(options.tables, options.base, run.control);
  std::vector<Reach> table;
  for (const SceneRuns& scene : scenes)
    for (const Reach& reach : reach_table(scene)) table.push_back(reach);
  write_text_atomically(options.output, report_page(scenes, options, run));
  if (!options.csv.empty()) write_text_atomically(options.csv, to_text(csv_of(table)));
  print_table(run, table);
  run.write_stats({{"scenes", scenes.size()}, {"tables", options.tables.size()}});
}

}  // namespace waylight
