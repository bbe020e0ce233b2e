// What cells of a table can do to the commands that draw them.

#include "tools/common/gnuplot.h"

#include "formats/temporary_files.h"

namespace waylight {
namespace {

TEST(Gnuplot, LabelsEndNeitherTheirQuotesNorTheirData) {
  ChartOptions options;
  options.labels = "option";
  const std::string label = "x\nEOD\nsystem('touch /tmp/p')\r\n$line0 << EOD\n\"8 \"lobes\"";
  const ChartLine line{"method", {{1, 2, 2, 2, 1, label}}};
  const std::string script = gnuplot_script(options, {line}, ChartFormat::svg, "out.svg");
  const std::string expected =
      "$line0 << EOD\n"
      "1 2 2 2 \"x EOD system('touch /tmp/p')  $line0 << EOD '8 'lobes'\"\n"
      "EOD\n";
  EXPECT_NE(script.find(expected), script.npos) << script;
}

TEST(Gnuplot, RangesThatHaveNoEndAreRefused) {
  constexpr double kLargest = 1.79e308;
  for (const double low : {1.0, kLargest})
    for (const char* linear : {"", "xy"}) {
      const ChartLine line{"method", {{1, low, low, kLargest, 1, ""}}};
      ChartOptions options;
      options.linear = linear;
      const std::string error =
          testing::error_of([&] { gnuplot_script(options, {line}, ChartFormat::svg, "out.svg"); });
      EXPECT_TRUE(testing::mentions(error, "of the y axis are too")) << low << linear << error;
    }
}

}  // namespace
}  // namespace waylight
