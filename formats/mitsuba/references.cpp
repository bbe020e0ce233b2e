#include "formats/mitsuba/references.h"

#include <algorithm>
#include <unordered_set>

namespace waylight::mitsuba {
namespace {

constexpr int kMaxHeight = 256;  // of nested elements, references followed

void add_id(Document& document, const std::string& id, const Element* element,
            const Element& place) {
  const auto [entry, is_new] = document.ids.emplace(id, element);
  if (!is_new) fail_at(place, "the id \"{}\" is already that of {}", id, entry->second->where());
}

void add_ids(Document& document, const Element& element) {
  for (const Element& child : element.children) {
    if (!child.id.empty() && child.tag != "ref") add_id(document, child.id, &child, child);
    add_ids(document, child);
  }
}

const Element& target(const Document& document, const Element& by) {
  const auto found = document.ids.find(by.id);
  if (found != document.ids.end()) return *found->second;
  std::vector<std::string> known;
  for (const auto& [id, element] : document.ids) known.push_back(id);
  std::sort(known.begin(), known.end());
  fail_at(by, "nothing has the id \"{}\"{}", by.id, did_you_mean(by.id, known));
}

void add_targets(const Document& document, const Element& element,
                 std::unordered_set<const Element*>& targets) {
  for (const Element& child : element.children) {
    if (child.tag == "ref") targets.insert(document.ids.at(child.id));
    add_targets(document, child, targets);
  }
}

class ReferenceCheck {
 public:
  explicit ReferenceCheck(const Document& document) : document_(document) {}

  int height(const Element& element, int depth) {
    int highest = 0;
    for (const Element& child : element.children)
      highest = std::max(highest, child.tag == "ref" ? height_of_target(child, depth + 1)
                                                     : remembered_height(child, depth + 1));
    return highest + 1;
  }

 private:
  static constexpr int kInProgress = -1;

  int height_of_target(const Element& ref, int depth) {
    const Element& element = target(document_, ref);
    const auto known = heights_.find(&element);
    if (known != heights_.end() && known->second == kInProgress)
      fail_at(ref, "{} contains itself", element.where());
    const int result = remembered_height(element, depth);
    if (std::max(result, depth) > kMaxHeight)
      fail_at(ref, "references are nested deeper than {}", kMaxHeight);
    return result;
  }

  int remembered_height(const Element& element, int depth) {
    if (depth > kMaxHeight) fail_at(element, "references are nested deeper than {}", kMaxHeight);
    if (element.id.empty()) return height(element, depth);
    const auto [entry, is_new] = heights_.emplace(&element, kInProgress);
    if (!is_new) return entry->second;
    const int result = height(element, depth);
    heights_[&element] = result;
    return result;
  }

  const Document& document_;
  std::unordered_map<const Element*, int> heights_;  // of those with an id
};

}  // namespace

void collect_ids(Document& document, const std::vector<Element>& aliases) {
  add_ids(document, document.root);
  for (const Element& alias : aliases) {
    const std::string* as = alias.attribute("as");
    if (alias.id.empty() || !as) fail_at(alias, "needs an id and \"as\"");
    add_id(document, *as, &target(document, alias), alias);
  }
}

std::vector<const Element*> unreferenced(const Document& document) {
  std::unordered_set<const Element*> targets;
  add_targets(document, document.root, targets);
  std::vector<const Element*> rest;
  for (const Element& element : document.root.children)
    if (!targets.count(&element)) rest.push_back(&element);
  return rest;
}

void check_references(const Document& document) {
  ReferenceCheck(document).height(document.root, 0);
}

}  // namespace waylight::mitsuba
