// Charts of a scene, drawn by gnuplot.

#include "formats/atomic_file.h"
#include "formats/file_bytes.h"
#include "tools/common/gnuplot.h"
#include "tools/report/figures.h"

namespace waylight {
namespace {

struct ChartSpec {
  const char *x, *y;  // columns of image-compare
  Field x_of, y_of;
  bool bars, preprocess;
};

constexpr Field kSeconds = [](const Checkpoint& c) { return c.seconds; };
constexpr Field kTotal = [](const Checkpoint& c) { return c.total_seconds(); };
constexpr Field kSpp = [](const Checkpoint& c) { return c.spp; };
constexpr Field kRelmse = [](const Checkpoint& c) { return c.relmse; };
constexpr Field kSample = [](const Checkpoint& c) { return c.sample_ms; };
constexpr Field kPath = [](const Checkpoint& c) { return c.path_length; };
constexpr Field kMemory = [](const Checkpoint& c) { return c.memory_bytes; };

constexpr ChartSpec kCharts[] = {{"seconds", "relmse", kSeconds, kRelmse, false, false},
                                 {"seconds", "relmse", kTotal, kRelmse, false, true},
                                 {"spp", "relmse", kSpp, kRelmse, false, false},
                                 {"seconds", "sample_ms", kSeconds, kSample, true, false},
                                 {"seconds", "path_length", kSeconds, kPath, true, false},
                                 {"seconds", "memory_bytes", kSeconds, kMemory, true, false}};

std::vector<ChartLine> lines_of(const SceneRuns& scene, const ChartSpec& spec) {
  std::vector<ChartLine> lines;
  for (const Method& method : scene.methods)
    lines.push_back(spec.bars ? ChartLine{method.name, {final_mean(method, spec.y_of)}}
                              : line_of(method, spec.x_of, spec.y_of));
  return lines;
}

std::string draw(const ChartOptions& options, const std::vector<ChartLine>& lines,
                 const std::string& output) {
  const AtomicFile scratch(output);  // never committed
  run_gnuplot(gnuplot_script(options, lines, ChartFormat::small_svg, scratch.temporary()));
  return inline_svg(read_whole_file(scratch.temporary()));
}

}  // namespace

std::string scene_charts(const SceneRuns& scene, const std::string& output) {
  std::string html;
  for (const ChartSpec& spec : kCharts) {
    ChartOptions options;
    options.x = spec.x;
    options.y = spec.y;
    options.bars = spec.bars;
    options.preprocess = spec.preprocess;
    const std::vector<ChartLine> lines = lines_of(scene, spec);
    if (lines[0].points[0].y > 0) html += draw(options, lines, output);
  }
  return "<div class=charts>\n" + html + "</div>\n";
}

std::string inline_svg(const std::string& svg) {
  const size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return {};
  std::string result = "<svg class=\"chart\"" + svg.substr(begin + 4);
  for (size_t title; (title = result.find("<title>")) != std::string::npos;)  // tooltips
    result.erase(title, result.find("</title>", title) + 8 - title);
  return result;
}

}  // namespace waylight
