#include "tools/common/csv.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "formats/file_bytes.h"

namespace waylight {
namespace {

// Cells of the record that begins at `offset`, which moves behind its end.
std::vector<std::string> next_record(const std::string& text, size_t& offset) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (; offset < text.size(); ++offset) {
    const char c = text[offset];
    if (quoted && c == '"' && offset + 1 < text.size() && text[offset + 1] == '"') {
      cells.back() += text[++offset];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      cells.emplace_back();
    } else if (!quoted && c == '\n') {
      ++offset;
      break;
    } else if (quoted || c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

CsvTable parse_csv(const std::string& text, const std::string& path) {
  CsvTable table;
  size_t offset = 0;
  table.columns = next_record(text, offset);
  for (int record = 2; offset < text.size(); ++record) {
    std::vector<std::string> cells = next_record(text, offset);
    if (cells == std::vector<std::string>{""}) continue;
    if (cells.size() != table.columns.size())
      fail("\"{}\": record {} has {} cells, the header has {}", path, record, cells.size(),
           table.columns.size());
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text(1, '"');
  for (char c : cell) text.append(c == '"' ? 2 : 1, c);
  text.push_back('"');
  return text;
}

// The row in the order of the columns.
std::vector<std::string> arrange(const CsvRow& row, const std::vector<std::string>& columns,
                                 const std::string& path) {
  std::vector<std::string> cells(columns.size());
  for (const auto& [column, cell] : row) {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end())
      fail("\"{}\": has no column \"{}\"; append to a new file", path, column);
    cells[found - columns.begin()] = cell;
  }
  return cells;
}

// A file that is locked against other processes while this object lives.
class LockedFile {
 public:
  explicit LockedFile(const std::string& path)
      : path_(path), file_(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX) != 0) {
      const int error = errno;
      if (file_ >= 0) ::close(file_);
      fail("\"{}\": cannot write: {}", path_, std::strerror(error));
    }
  }
  ~LockedFile() { ::close(file_); }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  // All of the text, or none: half a row would make the table unreadable.
  void append(std::string_view text) {
    const off_t size = ::lseek(file_, 0, SEEK_END);
    while (!text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) take_back(size, written < 0 ? errno : ENOSPC);
      text.remove_prefix(static_cast<size_t>(written));
    }
  }

 private:
  [[noreturn]] void take_back(off_t size, int error) {
    const bool whole = ::ftruncate(file_, size) == 0;
    fail("\"{}\": cannot write: {}{}", path_, std::strerror(error),
         whole ? "" : "; its last row is incomplete, remove it");
  }

  std::string path_;
  int file_;
};

}  // namespace

int CsvTable::find(const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

int column_of(const CsvTable& table, const std::string& column, const std::string& path) {
  const int index = table.find(column);
  if (index < 0)
    fail("\"{}\": has no column \"{}\" among {}", path, column, fmt::join(table.columns, ", "));
  return index;
}

std::optional<double> finite_number(const std::string& cell) {
  double value = 0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

double number_in(const std::string& cell, const std::string& what) {
  const std::optional<double> value = finite_number(cell);
  if (!value) fail("{} is \"{}\", not a number", what, cell);
  return *value;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line.append(quoted(cell)).push_back(',');
  line.back() = '\n';
  return line;
}

CsvTable read_csv(const std::string& path) {
  const std::string text = read_whole_file(path);
  if (text.empty()) fail("\"{}\": is empty, a header is needed", path);
  return parse_csv(text, path);
}

void append_csv(const std::string& path, const CsvRow& row) {
  LockedFile file(path);
  const std::string text = read_whole_file(path);
  std::vector<std::string> columns;
  std::string addition;
  if (text.empty()) {
    for (const auto& [column, cell] : row) columns.push_back(column);
    addition = csv_line(columns);
  } else {
    columns = parse_csv(text, path).columns;
    if (text.back() != '\n') addition.push_back('\n');
  }
  file.append(addition + csv_line(arrange(row, columns, path)));
}

std::string to_text(const CsvTable& table) {
  std::string text = csv_line(table.columns);
  for (const std::vector<std::string>& row : table.rows) text += csv_line(row);
  return text;
}

}  // namespace waylight
