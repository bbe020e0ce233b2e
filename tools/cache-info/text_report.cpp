#include "tools/cache-info/text_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace waylight {
namespace {

using Json = nlohmann::ordered_json;

std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string scalar(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
  return value.dump();
}

// "least 1, mean 2, largest 3"
std::string in_line(const Json& object) {
  std::string text;
  for (const auto& [name, value] : object.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", words(name), scalar(value));
  return text;
}

std::string name_column(const std::string& name) { return fmt::format("{:<19} ", words(name)); }

std::vector<std::vector<std::string>> cells_of(const Json& rows) {
  std::vector<std::vector<std::string>> cells(1);
  for (const auto& [name, value] : rows[0].items()) cells[0].push_back(words(name));
  for (const Json& row : rows) {
    cells.emplace_back();
    for (const Json& value : row) cells.back().push_back(scalar(value));
  }
  return cells;
}

void add_table(const Json& rows, std::vector<std::string>& lines) {
  const std::vector<std::vector<std::string>> cells = cells_of(rows);
  std::vector<size_t> widths(cells[0].size());
  for (const auto& row : cells)
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const auto& row : cells) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) line += fmt::format("  {:<{}}", row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
}

void add_entry(const std::string& name, const Json& value, std::vector<std::string>& lines) {
  if (!value.is_structured()) {
    lines.push_back(name_column(name) + scalar(value));
  } else if (value.is_array()) {
    lines.push_back(value.empty() ? name_column(name) + "none" : words(name));
    if (!value.empty()) add_table(value, lines);
  } else if (std::any_of(value.begin(), value.end(),
                         [](const Json& part) { return part.is_structured(); })) {
    for (const auto& [part, inner] : value.items()) add_entry(name + " " + part, inner, lines);
  } else {
    lines.push_back(name_column(name) + in_line(value));
  }
}

}  // namespace

std::vector<std::string> text_report(const Json& info) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : info.items()) add_entry(name, value, lines);
  return lines;
}

}  // namespace waylight
