#include "formats/mitsuba/element.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace waylight::mitsuba {
namespace {

namespace fs = std::filesystem;

// Insertions, deletions, replacements and swaps of neighbours [Damerau 1964, restricted].
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

// Enough for all types and presets; the ids of a scene may be thousands.
std::string list_of(const std::vector<std::string>& names) {
  constexpr ptrdiff_t kMost = 40;
  if (names.empty()) return "";
  const bool all = std::ssize(names) <= kMost;
  return fmt::format("; known are {}{}",
                     fmt::join(names.begin(), all ? names.end() : names.begin() + kMost, ", "),
                     all ? "" : ", ...");
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

const std::string* Element::attribute(const std::string& key) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? nullptr : &found->second;
}

std::string Element::where() const {
  std::string label = tag;
  if (!type.empty())
    label += fmt::format(" type=\"{}\"", type);
  else if (!name.empty())
    label += fmt::format(" name=\"{}\"", name);
  else if (!id.empty())
    label += fmt::format(" id=\"{}\"", id);
  return fmt::format("\"{}\":{}: <{}>", file, line, label);
}

std::string Document::find_file(const Element& by, const std::string& relative) const {
  if (relative.empty()) fail_at(by, "the name of a file is empty");
  const fs::path wanted(relative);
  std::vector<fs::path> folders = {fs::path(by.file).parent_path(), fs::path(path).parent_path()};
  folders.insert(folders.end(), search_folders.begin(), search_folders.end());
  for (const fs::path& folder : folders)  // folder / absolute is absolute
    if (is_file(folder / wanted)) {
      const std::string found = (folder / wanted).string();
      if (on_file) on_file(found);
      return found;
    }
  fail_at(by, "there is no file \"{}\" beside it, beside \"{}\" or in a <path> folder", relative,
          path);
}

const std::string* nearest_name(const std::string& unknown, const std::vector<std::string>& known) {
  constexpr size_t kLongest = 128;  // names beyond are no slips, and the distance is quadratic
  if (unknown.size() > kLongest) return nullptr;
  const std::string* nearest = nullptr;
  size_t least = std::max<size_t>(2, unknown.size() / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongest) continue;
    const size_t distance = edit_distance(unknown, candidate);
    if (distance < least && distance < candidate.size()) least = distance, nearest = &candidate;
  }
  return nearest;
}

std::string did_you_mean(const std::string& unknown, const std::vector<std::string>& known) {
  const std::string* nearest = nearest_name(unknown, known);
  return nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : list_of(known);
}

}  // namespace waylight::mitsuba
