#pragma once
// Tables of comma-separated values with a header row [RFC 4180].

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace waylight {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // each as long as `columns`

  int find(const std::string& column) const;  // its index, or -1
};

// Throws Error naming path and line of the defect.
CsvTable read_csv(const std::string& path);

// The index of a column that has to be there; throws Error naming path and columns.
int column_of(const CsvTable& table, const std::string& column, const std::string& path);

// The cell as a finite number, where it is one.
std::optional<double> finite_number(const std::string& cell);
// The same; throws Error that begins with `what`.
double number_in(const std::string& cell, const std::string& what);

// The cells as one line of a table, its newline included.
std::string csv_line(const std::vector<std::string>& cells);

using CsvRow = std::vector<std::pair<std::string, std::string>>;  // column, cell

// Adds one row; a new or empty file gets the columns of the row as its header first. Columns that
// the row lacks stay empty. Throws Error when the file lacks a column of the row. Safe against
// other processes that append at the same time.
void append_csv(const std::string& path, const CsvRow& row);

// The text of a table.
std::string to_text(const CsvTable& table);

}  // namespace waylight
