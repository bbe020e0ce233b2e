// What cells of a table can do to the commands that draw them.

#include "tools/common/gnuplot.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace waylight
