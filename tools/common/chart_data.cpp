#include "tools/common/chart_data.h"

#include <algorithm>
#include <set>

#include "libguide/base/error.h"
#include "tools/common/csv.h"

namespace waylight {
namespace {

constexpr double kEqualSeconds = 0.05;  // relative

struct Row {
  std::string scene, method, label;
  double x, y;
  double shared;  // x before preprocessing is added, by which rows are told to be of one point
};

bool can_be_shown(const Row& row, const ChartOptions& options) {
  return (options.is_linear('x') || row.x > 0) && (options.is_linear('y') || row.y > 0);
}

// Rows that cannot be shown are left out with a warning: errors without the noise of the reference
// can be negative, and one of them is no reason to show nothing.
void read_rows(const std::string& path, const ChartOptions& options, const RunControl& control,
               std::vector<Row>& rows) {
  const CsvTable table = read_csv(path);
  const int x = column_of(table, options.x, path), y = column_of(table, options.y, path);
  const int method = column_of(table, options.lines, path), scene = table.find("scene");
  const int preprocess = options.preprocess ? column_of(table, "preprocess_seconds", path) : -1;
  const int label = options.labels.empty() ? -1 : column_of(table, options.labels, path);
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const std::vector<std::string>& cells = table.rows[i];
    const auto what = [&](const std::string& column) {
      return fmt::format("\"{}\": record {}: {}", path, i + 2, column);
    };
    Row row{scene < 0 ? "" : cells[scene],        cells[method],
            label < 0 ? "" : cells[label],        number_in(cells[x], what(options.x)),
            number_in(cells[y], what(options.y)), 0};
    row.shared = row.x;
    if (!can_be_shown(row, options)) {
      control.warn(fmt::format("{} {}, {} {} cannot be shown on a logarithmic axis and is left out",
                               what(options.x), cells[x], options.y, cells[y]));
      continue;
    }
    if (preprocess >= 0 && !cells[preprocess].empty())
      row.x += number_in(cells[preprocess], what("preprocess_seconds"));
    rows.push_back(std::move(row));
  }
}

ChartPoint merge(const Row* first, const Row* last) {
  ChartPoint point{first->x,    first->y, first->y, first->y, static_cast<int>(last - first),
                   first->label};
  for (const Row* row = first + 1; row != last; ++row) {
    point.x += (row->x - first->x) / point.rows;
    point.y += (row->y - first->y) / point.rows;
    point.low = std::min(point.low, row->y);
    point.high = std::max(point.high, row->y);
  }
  return point;
}

// Points with labels are those of a choice: one for each label, in the order of the table.
std::vector<ChartPoint> merge_labels(const std::vector<Row>& rows) {
  std::vector<std::vector<Row>> groups;
  for (const Row& row : rows) {
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& g) { return g[0].label == row.label; });
    group == groups.end() ? groups.push_back({row}) : group->push_back(row);
  }
  std::vector<ChartPoint> points;
  for (const std::vector<Row>& group : groups)
    points.push_back(merge(group.data(), group.data() + group.size()));
  return points;
}

std::vector<ChartPoint> merge_equal(std::vector<Row> rows, double tolerance) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return a.shared < b.shared; });
  std::vector<ChartPoint> points;
  for (size_t begin = 0; begin < rows.size();) {
    size_t end = begin + 1;
    while (end < rows.size() &&
           rows[end].shared - rows[begin].shared <= rows[begin].shared * tolerance)
      ++end;
    points.push_back(merge(&rows[begin], &rows[begin] + (end - begin)));
    begin = end;
  }
  return points;
}

}  // namespace

void ChartOptions::validate() const {
  require(!tables.empty(), "no table is given");
  for (char axis : linear)
    require(axis == 'x' || axis == 'y', "--linear {} is not x, y or xy", linear);
  require(!preprocess || x == "seconds", "--preprocess needs --x seconds");
  require(!bars || !preprocess, "--bars has no time to add --preprocess to");
  require(standard.empty() || (!labels.empty() && !bars),
          "--default is one of the --labels, beside the points of lines");
  require(output.ends_with(".svg"), "-o \"{}\" does not end in .svg", output);
}

ChartOptions with_columns_of_table(const ChartOptions& options) {
  const ChartOptions standard;
  if (options.x != standard.x || options.y != standard.y || options.preprocess) return options;
  const CsvTable table = read_csv(options.tables[0]);
  if (table.find("seconds") >= 0 || table.find("edges") < 0 || table.find("contribution") < 0)
    return options;
  ChartOptions result = options;
  result.x = "edges";
  result.y = "contribution";
  result.linear = "xy";
  return result;
}

std::vector<ChartPoint> points_of(const std::vector<ChartLine>& lines, const std::string& label) {
  std::vector<ChartPoint> points;
  for (const ChartLine& line : lines)
    for (const ChartPoint& p : line.points)
      if (p.label == label) points.push_back(p);
  return points;
}

std::vector<ChartLine> chart_lines(const ChartOptions& options, const RunControl& control) {
  std::vector<Row> rows;
  for (const std::string& path : options.tables) read_rows(path, options, control, rows);
  if (rows.empty()) fail("\"{}\": there are no rows to show", options.tables[0]);
  std::set<std::string> scenes;
  for (const Row& row : rows) scenes.insert(row.scene);
  std::vector<std::string> names;
  std::vector<std::vector<Row>> groups;
  for (const Row& row : rows) {
    const std::string method = row.method.empty() ? "(none)" : row.method;
    const std::string name = scenes.size() > 1 ? row.scene + ", " + method : method;
    const size_t group = std::find(names.begin(), names.end(), name) - names.begin();
    if (group == names.size()) {
      names.push_back(name);
      groups.emplace_back();
    }
    groups[group].push_back(row);
  }
  const double tolerance = options.x.ends_with("seconds") ? kEqualSeconds : 0;
  std::vector<ChartLine> lines;
  for (size_t i = 0; i < names.size(); ++i)
    lines.push_back({names[i], options.labels.empty() ? merge_equal(groups[i], tolerance)
                                                      : merge_labels(groups[i])});
  if (!options.standard.empty() && points_of(lines, options.standard).empty())
    fail("\"{}\": no row has the --default \"{}\" in column {}", options.tables[0],
         options.standard, options.labels);
  if (options.bars)
    for (ChartLine& line : lines) line.points = {line.points.back()};
  return lines;
}

}  // namespace waylight
