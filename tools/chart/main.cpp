// chart: error over time from the tables of image-compare.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "libguide/base/error.h"
#include "tools/chart/chart_tool.h"

namespace {

void add_options(CLI::App& app, waylight::ChartOptions& options) {
  app.add_option("tables", options.tables, "Tables that `image-compare --csv` wrote")->required();
  app.add_option("-o,--output", options.output, "Chart to write (.svg)")->required();
  app.add_option("--title", options.title, "Title of the chart");
  app.add_option("--x", options.x, "seconds or spp")->capture_default_str();
  app.add_option("--y", options.y, "relmse, mse, relmse_trimmed or mape")->capture_default_str();
  app.add_flag("--preprocess", options.preprocess, "Add preprocess_seconds to the seconds");
  app.add_flag("--png", options.png, "Write a PNG of the same name too");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Error over time, one line per method");
  waylight::ChartOptions options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    waylight::chart(options);
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "chart: {}\n", e.what());
    return dynamic_cast<const waylight::Misuse*>(&e) ? 2 : 1;
  }
}
