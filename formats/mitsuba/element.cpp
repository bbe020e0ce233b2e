#include "formats/mitsuba/element.h"

#include <fmt/ranges.h>

#include <filesystem>

#include "libguide/base/nearest_name.h"

namespace waylight::mitsuba {
namespace {

namespace fs = std::filesystem;

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

std::string did_you_mean(const std::string& unknown, const std::vector<std::string>& known) {
  const std::string* nearest = nearest_name(unknown, known);
  return nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : list_of(known);
}

}  // namespace waylight::mitsuba
