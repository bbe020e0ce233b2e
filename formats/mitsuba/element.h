#pragma once
// A scene file as a tree of elements, the same for both dialects: includes spliced, $names
// replaced, old spellings brought to the new ones. Everything after this sees one form.

#include <fmt/format.h>

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "formats/mitsuba.h"
#include "libguide/base/error.h"

namespace waylight::mitsuba {

struct Element {
  std::string tag;   // "shape", "bsdf", "float", "rgb", "transform", "lookat", "ref", ...
  std::string type;  // of an object: the plugin, for example "roughconductor"
  std::string name;  // of a property, in snake_case: "to_world", "int_ior"
  std::string id;
  std::map<std::string, std::string>
      attributes;  // the others: value, x, y, z, angle, filename, ...
  std::string file;
  int line = 0;
  std::vector<Element> children;

  const std::string* attribute(const std::string& key) const;  // nullptr when it is not there
  std::string where() const;  // "scene.xml":12: <bsdf type="diffuse">
};

// A parsed scene. Elements stay where they are for its life: pointers to them are their identity.
struct Document {
  Element root;              // <scene>
  bool old_dialect = false;  // version below 2
  std::string path;
  std::vector<std::string> search_folders;  // of <path> elements
  std::unordered_map<std::string, const Element*> ids;
  std::vector<std::string> unused_defines;          // -D names that no $name asked for
  std::function<void(const std::string&)> on_file;  // may be empty; of each that is found

  // `relative` as named by an element: beside that element's file, then the main file, then the
  // search folders. Throws Error naming the file that referred to it.
  std::string find_file(const Element& by, const std::string& relative) const;
};

Document parse_document(const std::string& path, const ImportOptions& options);

template <typename... Args>
[[noreturn]] void fail_at(const Element& element, fmt::format_string<Args...> format,
                          Args&&... args) {
  throw Error(
      fmt::format("{}: {}", element.where(), fmt::format(format, std::forward<Args>(args)...)));
}

// The nearest name as a clause, "; did you mean \"diffuse\"?", else the known ones:
// "; known are conductor, diffuse". Empty when nothing is known.
std::string did_you_mean(const std::string& unknown, const std::vector<std::string>& known);

}  // namespace waylight::mitsuba
