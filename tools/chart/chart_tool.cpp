#include "tools/chart/chart_tool.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "tools/common/gnuplot.h"

namespace waylight {

void chart(const ToolRun& run, const ChartOptions& given) {
  given.validate();
  const ChartOptions options = with_columns_of_table(given);
  const std::vector<ChartLine> lines = chart_lines(options, run.control);
  const auto draw = [&](ChartFormat format, const std::string& path) {
    write_atomically(path, [&](const std::string& temporary) {
      run_gnuplot(gnuplot_script(options, lines, format, temporary));
    });
  };
  draw(ChartFormat::svg, options.output);
  if (options.png)
    draw(ChartFormat::png, std::filesystem::path(options.output).replace_extension(".png"));
  size_t points = 0;
  for (const ChartLine& line : lines) points += line.points.size();
  run.write_stats({{"tables", options.tables.size()}, {"lines", lines.size()}, {"points", points}});
}

}  // namespace waylight
