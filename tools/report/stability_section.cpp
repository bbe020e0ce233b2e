// The table of pipelines/stability.mk as a part of the page: cases down, methods across.

#include <algorithm>

#include "libguide/base/error.h"
#include "tools/common/csv.h"
#include "tools/report/html.h"
#include "tools/report/page.h"

namespace waylight {
namespace {

// One cell of the table, as the file has it.
struct StabilityCell {
  std::string name, row, set, method, status, verdict, reason;  // `name` and `row` of the case
};

std::vector<StabilityCell> read_cells(const std::string& path) {
  const CsvTable table = read_csv(path);
  const auto column = [&](const char* name) { return column_of(table, name, path); };
  const int name = column("case"), row = column("row"), set = column("set");
  const int method = column("method"), status = column("status"), verdict = column("verdict");
  const int reason = column("reason");
  std::vector<StabilityCell> cells;
  for (const std::vector<std::string>& r : table.rows)
    cells.push_back({r[name], r[row], r[set], r[method], r[status], r[verdict], r[reason]});
  return cells;
}

// In the order of their first cell.
std::vector<std::string> distinct(const std::vector<StabilityCell>& cells,
                                  std::string StabilityCell::*member) {
  std::vector<std::string> values;
  for (const StabilityCell& cell : cells)
    if (std::find(values.begin(), values.end(), cell.*member) == values.end())
      values.push_back(cell.*member);
  return values;
}

std::vector<StabilityCell> where(const std::vector<StabilityCell>& cells,
                                 std::string StabilityCell::*member, const std::string& value) {
  std::vector<StabilityCell> found;
  for (const StabilityCell& cell : cells)
    if (cell.*member == value) found.push_back(cell);
  return found;
}

std::string verdict_html(const StabilityCell& cell) {
  return "<span class=\"" + escaped(cell.status) + "\" title=\"" + escaped(cell.reason) + "\">" +
         escaped(cell.verdict) + "</span>";
}

// A method that a case does not concern has an empty cell.
std::string set_table(const std::vector<StabilityCell>& cells) {
  const std::vector<std::string> methods = distinct(cells, &StabilityCell::method);
  std::vector<std::string> heading = {"case", "row"};
  for (const std::string& method : methods) heading.push_back(escaped(method));
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : distinct(cells, &StabilityCell::name)) {
    const std::vector<StabilityCell> own = where(cells, &StabilityCell::name, name);
    std::vector<std::string> row = {escaped(name), escaped(own[0].row)};
    for (const std::string& method : methods) {
      const std::vector<StabilityCell> cell = where(own, &StabilityCell::method, method);
      row.push_back(cell.empty() ? "" : verdict_html(cell[0]));
    }
    rows.push_back(row);
  }
  return "<h3>" + escaped(cells[0].set) + "</h3>\n" + html_table(heading, rows, true);
}

std::string known_failures(const std::vector<StabilityCell>& cells) {
  std::string items;
  for (const std::string& reason : distinct(cells, &StabilityCell::reason)) {
    if (reason.empty()) continue;
    std::string names;
    for (const StabilityCell& cell : where(cells, &StabilityCell::reason, reason))
      names += (names.empty() ? "" : ", ") + escaped(cell.name + " " + cell.method);
    items += "<li>" + names + ": " + escaped(reason) + "</li>\n";
  }
  return items.empty() ? "" : "<h3>Known failures</h3>\n<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string stability_section(const std::string& path) {
  if (path.empty()) return {};
  const std::vector<StabilityCell> cells = read_cells(path);
  if (cells.empty()) fail("\"{}\": the table has no rows", path);
  std::string html =
      "<section id=stability><h2>Stability</h2>\n<p>Cases in which guiding may fail, methods "
      "across: pass, or the figure that failed. With the pointer on one, why.</p>\n";
  for (const std::string& set : distinct(cells, &StabilityCell::set))
    html += set_table(where(cells, &StabilityCell::set, set));
  return html + known_failures(cells) + "</section>\n";
}

}  // namespace waylight
