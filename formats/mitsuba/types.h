#pragma once
// Choice among named things, with an error that names the nearest one, and of single objects.

#include "formats/mitsuba/properties.h"

namespace waylight::mitsuba {

template <typename Value>
std::vector<std::string> names_of(const std::map<std::string, Value>& table) {
  std::vector<std::string> names;
  for (const auto& [name, value] : table)
    if (!name.empty()) names.push_back(name);
  return names;
}

// What the table has for the type of an element; `what` names the kind: "texture", "emitter".
template <typename Importer>
Importer importer_of(const Element& element, const std::map<std::string, Importer>& table,
                     const char* what) {
  const auto found = table.find(element.type);
  if (found != table.end()) return found->second;
  fail_at(element, "unknown {} \"{}\"{}", what, element.type,
          did_you_mean(element.type, names_of(table)));
}

// What the table has for the text of a property.
template <typename Value>
Value choose(Properties& properties, const std::string& name,
             const std::map<std::string, Value>& table, const std::string& otherwise) {
  const std::string text = properties.text(name, otherwise);
  const auto found = table.find(text);
  if (found != table.end()) return found->second;
  fail_at(properties.element(), "unknown {} \"{}\"{}", name, text,
          did_you_mean(text, names_of(table)));
}

// The one nested object of a tag, or nullptr.
inline const Element* single(Properties& properties, const std::string& tag) {
  const std::vector<const Element*> found = properties.objects(tag);
  if (found.size() > 1)
    fail_at(properties.element(), "has {} <{}>, one is possible", found.size(), tag);
  return found.empty() ? nullptr : found.front();
}

// For messages: the id, or "<type>@line N".
inline std::string label_of(const Element& element) {
  return element.id.empty() ? fmt::format("{}@line {}", element.type, element.line) : element.id;
}

}  // namespace waylight::mitsuba
