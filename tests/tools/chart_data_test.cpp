// Rows that become a point of a chart, and those that cannot.

#include "tools/common/chart_data.h"

#include "formats/atomic_file.h"
#include "formats/temporary_files.h"

namespace waylight {
namespace {

using testing::error_of;
using testing::mentions;

class ChartDataTest : public testing::TemporaryFiles {
 protected:
  // Of rows `method,seconds,preprocess_seconds,relmse`; what was warned of stays in `warnings`.
  std::vector<ChartLine> lines_of(const std::string& rows) {
    options.tables = {path("t.csv")};
    write_text_atomically(options.tables[0], "method,seconds,preprocess_seconds,relmse\n" + rows);
    RunControl control;
    control.on_warning = [this](const std::string& message) { warnings += message + '\n'; };
    return chart_lines(options, control);
  }

  ChartOptions options;
  std::string warnings;
};

TEST_F(ChartDataTest, PreprocessingMakesNoTwoCheckpointsOne) {
  options.preprocess = true;
  const std::vector<ChartLine> lines =
      lines_of("a,2,88,0.4\na,4,88,0.2\na,2.05,88,0.4\na,4.02,88,0.2\n");
  ASSERT_EQ(lines[0].points.size(), 2u);
  EXPECT_DOUBLE_EQ(lines[0].points[0].x, 90.025);
  EXPECT_DOUBLE_EQ(lines[0].points[1].x, 92.01);
}

TEST_F(ChartDataTest, MeansOverSeedsAreArithmetic) {
  const ChartPoint point = lines_of("a,2,0,0.1\na,2,0,0.5\n")[0].points.at(0);
  EXPECT_DOUBLE_EQ(point.y, 0.3);
  EXPECT_EQ(point.low, 0.1);
  EXPECT_EQ(point.high, 0.5);
}

TEST_F(ChartDataTest, ErrorsBelowTheNoiseAreLeftOutWithAWarning) {
  const std::vector<ChartLine> lines = lines_of("a,2,0,0.1\na,4,0,-0.01\nb,2,0,0.2\n");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].points.size(), 1u);
  EXPECT_TRUE(mentions(warnings, "record 3: seconds 4, relmse -0.01 cannot be shown")) << warnings;
  EXPECT_TRUE(mentions(error_of([&] { lines_of("a,4,0,-0.01\n"); }), "no rows to show"));
}

TEST_F(ChartDataTest, SlopeIsOfSquaredErrorsOverTheTimeOfRendering) {
  for (const char* y : {"mse", "relmse", "relmse_trimmed"}) {
    options.y = y;
    EXPECT_TRUE(options.has_slope()) << y;
  }
  options.preprocess = true;
  EXPECT_FALSE(options.has_slope());
  options.preprocess = false;
  for (const char* y : {"mape", "sample_ms", "path_length", "contribution"}) {
    options.y = y;
    EXPECT_FALSE(options.has_slope()) << y;
  }
}

}  // namespace
}  // namespace waylight
