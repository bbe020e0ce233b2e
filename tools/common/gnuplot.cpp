#include "tools/common/gnuplot.h"

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>

#include "libguide/base/error.h"

namespace waylight {
namespace {

// Told apart by readers with any colour vision [Okabe, Ito 2008, Color Universal Design].
constexpr std::array kColors{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                             "#E69F00", "#56B4E9", "#5A5A5A"};
constexpr std::array kPointTypes{7, 5, 9, 13, 11, 15};  // filled disk, square, triangles, ...

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void extend(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // At least a factor of two, and room beside the outermost points.
  Range padded() const {
    const double factor = std::max(1.15, std::sqrt(2 * low / high));
    return {low / factor, high * factor};
  }
  // The same for a linear axis, which begins at zero where no value is negative.
  Range padded_linear() const {
    const double room = high > low ? 0.05 * (high - low) : std::max(std::abs(high), 1.0);
    return {low >= 0 ? 0 : low - room, high + room};
  }
};

// Gnuplot expands nothing inside single quotes.
std::string quoted(const std::string& text) {
  std::string result(1, '\'');
  for (char c : text) {
    if (c == '\'') result += c;
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  result.push_back('\'');
  return result;
}

// A label between the double quotes of a data block, where nothing stands for a quote, and a line
// of its own would end the block.
std::string in_data(std::string label) {
  for (char& c : label) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
    if (c == '"') c = '\'';
  }
  return label;
}

std::string axis_commands(char axis, const Range& values, bool linear) {
  if (linear) {
    const Range range = values.padded_linear();
    if (!std::isfinite(range.low) || !std::isfinite(range.high))
      fail("values from {:g} to {:g} of the {} axis are too large to show", values.low, values.high,
           axis);
    return fmt::format("set {}range [{:.9g}:{:.9g}]\n", axis, range.low, range.high);
  }
  const Range range = values.padded();
  if (!std::isfinite(range.high) || !(range.low > 0))
    fail("values from {:g} to {:g} of the {} axis are too far apart or too large to show",
         values.low, values.high, axis);
  std::string ticks;
  for (double tick : logarithmic_ticks(range.low, range.high))
    ticks += fmt::format("{}'{:g}' {:.9g}", ticks.empty() ? "" : ", ", tick, tick);
  return fmt::format("set logscale {0}\nset {0}range [{1:.9g}:{2:.9g}]\nset {0}tics ({3})\n", axis,
                     range.low, range.high, ticks);
}

std::string terminal(ChartFormat format) {
  if (format == ChartFormat::png)
    return "set terminal pngcairo noenhanced size 1350,900 font 'Sans,16' background '#ffffff'\n";
  return fmt::format(
      "set terminal svg noenhanced size {} dynamic font 'Helvetica,15' background '#ffffff'\n",
      format == ChartFormat::svg ? "900,600" : "560,390");
}

std::string label_of(const std::string& column) {
  if (column == "seconds") return "render time (s)";
  if (column == "cpu_seconds") return "processor time of rendering (s)";
  if (column == "spp") return "samples per pixel";
  if (column == "relmse") return "relMSE";
  if (column == "relmse_trimmed") return "relMSE without the worst 0.1 % of the pixels";
  if (column == "mape") return "MAPE";
  if (column == "mse") return "MSE";
  if (column == "fit_seconds") return "time of fitting (s)";
  if (column == "held_out_error") return "error on samples not fitted to";
  if (column == "edges") return "path edges";
  if (column == "contribution") return "share of the luminance";
  if (column == "sample_ms") return "time per sample of every pixel (ms)";
  if (column == "path_length") return "edges per path";
  if (column == "memory_bytes") return "peak memory";
  return column;
}

std::string data_block(const std::string& name, const std::vector<ChartPoint>& points) {
  std::string block = fmt::format("${} << EOD\n", name);
  for (const ChartPoint& p : points)
    block += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} \"{}\"\n", p.x, p.y, p.low, p.high,
                         in_data(p.label));
  return block + "EOD\n";
}

bool has_band(const ChartLine& line) {
  for (const ChartPoint& p : line.points)
    if (p.rows > 1) return true;
  return false;
}

// Bands first, then the slope, then the lines on top.
std::string plot_command(const std::vector<ChartLine>& lines, bool slope) {
  std::string command = "plot ";
  for (size_t i = 0; i < lines.size(); ++i)
    if (has_band(lines[i]))
      command += fmt::format(
          "$line{} using 1:3:4 with filledcurves fillcolor rgb '{}' fillstyle transparent solid "
          "0.18 noborder notitle, ",
          i, kColors[i % kColors.size()]);
  const ChartPoint& anchor = lines[0].points[0];
  if (slope)
    command += fmt::format(
        "{:.9g}/x with lines linecolor rgb '#9a9a9a' linewidth 1.5 dashtype 2 title 'slope -1', ",
        anchor.x * anchor.y);
  for (size_t i = 0; i < lines.size(); ++i)
    command += fmt::format(
        "{}$line{} using 1:2 with linespoints linecolor rgb '{}' linewidth 2.5 pointtype {} "
        "pointsize 0.9 title {}",
        i ? ", " : "", i, kColors[i % kColors.size()], kPointTypes[i % kPointTypes.size()],
        quoted(lines[i].name));
  return command;
}

// A ring about the default of each line and, where it tells which values are better, the curve of
// the same error times time.
std::string default_plots(const std::vector<ChartPoint>& defaults, bool product) {
  std::string command =
      ", $default using 1:2 with points pointtype 6 pointsize 2 linewidth 2 "
      "linecolor rgb '#202020' title 'default'";
  if (product)
    command += fmt::format(
        ", {:.9g}/x with lines linecolor rgb '#9a9a9a' linewidth 1.5 dashtype 2 "
        "title 'the same error x time'",
        defaults[0].x * defaults[0].y);
  return command;
}

std::string label_plots(const std::vector<ChartLine>& lines) {
  std::string command;
  for (size_t i = 0; i < lines.size(); ++i)
    command += fmt::format(
        ", $line{} using 1:2:5 with labels left offset 0.8,0.6 textcolor rgb '{}' notitle", i,
        kColors[i % kColors.size()]);
  return command;
}

// Each line's bar stands at its own number, with its range over seeds.
std::string bar_commands(const std::vector<ChartLine>& lines) {
  std::string ticks, plots;
  for (size_t i = 0; i < lines.size(); ++i) {
    const char* separator = i ? ", " : "";
    ticks += fmt::format("{}{} {}", separator, quoted(lines[i].name), i);
    plots += fmt::format("{}$line{} using ({}):2 with boxes linecolor rgb '{}' notitle", separator,
                         i, i, kColors[i % kColors.size()]);
    if (has_band(lines[i]))
      plots += fmt::format(
          ", $line{} using ({}):3:(0):($4-$3) with vectors nohead linecolor rgb '#202020' "
          "linewidth "
          "1.5 notitle",
          i, i);
  }
  return fmt::format(
      "set boxwidth 0.6\nset style fill solid 0.85\nset xrange [-0.6:{}]\nset xtics ({}) scale 0\n"
      "set grid noxtics\nplot {}\n",
      lines.size() - 0.4, ticks, plots);
}

}  // namespace

std::vector<double> logarithmic_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  const std::vector<double> digits = decades > 2.5   ? std::vector<double>{1}
                                     : decades > 0.8 ? std::vector<double>{1, 2, 5}
                                                     : std::vector<double>{1, 1.5, 2, 3, 4, 5, 7};
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10, power) <= high;
       ++power)
    for (double digit : digits)
      if (const double tick = digit * std::pow(10, power); tick >= low && tick <= high)
        ticks.push_back(tick);
  return ticks;
}

std::string gnuplot_script(const ChartOptions& options, const std::vector<ChartLine>& lines,
                           ChartFormat format, const std::string& output) {
  Range x, y;
  for (const ChartLine& line : lines)
    for (const ChartPoint& p : line.points) {
      x.extend(p.x);
      y.extend(p.low);
      y.extend(p.high);
    }
  std::string script = terminal(format) + "set output " + quoted(output) + "\n";
  for (size_t i = 0; i < lines.size(); ++i)
    script += data_block(fmt::format("line{}", i), lines[i].points);
  std::vector<ChartPoint> defaults;
  if (!options.standard.empty()) defaults = points_of(lines, options.standard);
  if (!defaults.empty()) script += data_block("default", defaults);
  script += "set encoding utf8\nset samples 200\n";
  if (!options.bars) script += axis_commands('x', x, options.is_linear('x'));
  script += axis_commands('y', y, options.is_linear('y'));
  const std::string x_label =
      options.preprocess ? "preprocessing and render time (s)" : label_of(options.x);
  if (!options.bars) script += "set xlabel " + quoted(x_label) + "\n";
  script += "set ylabel " + quoted(label_of(options.y)) + "\n";
  if (options.y == "memory_bytes") script += "set format y '%.0s %cB'\n";
  if (!options.title.empty()) script += "set title " + quoted(options.title) + "\n";
  script +=
      "set border 3 linecolor rgb '#404040'\nset tics nomirror out textcolor rgb '#202020'\n"
      "set grid linecolor rgb '#dcdcdc' linewidth 1 linetype 1\n"
      "set key samplen 2.5 spacing 1.3 width 1 noautotitle ";
  script += format == ChartFormat::small_svg ? "below horizontal\n" : "top right opaque\n";
  if (options.bars) return script + bar_commands(lines);
  script += plot_command(lines, options.has_slope());
  if (!options.labels.empty()) script += label_plots(lines);
  if (!defaults.empty()) script += default_plots(defaults, options.has_product());
  return script + "\n";
}

void run_gnuplot(const std::string& script) {
  // A gnuplot that ends early is told by its status, not by a signal that ends us.
  const auto old_handler = std::signal(SIGPIPE, SIG_IGN);
  // Under LC_ALL=C gnuplot warns of a degree sign that no chart has.
  std::FILE* pipe = ::popen("exec env LC_ALL=C.UTF-8 gnuplot -d", "w");
  if (!pipe) fail("gnuplot cannot be started");
  std::fwrite(script.data(), 1, script.size(), pipe);
  const int status = ::pclose(pipe);
  std::signal(SIGPIPE, old_handler);
  constexpr int kNotFound = 127 << 8;
  if (status == kNotFound)
    fail("gnuplot was not found; install it (Debian: apt-get install gnuplot-nox)");
  if (status != 0) fail("gnuplot ended with status {}; its message is above", status >> 8);
}

}  // namespace waylight
