#include "formats/mitsuba/properties.h"

#include "formats/mitsuba/dialect.h"
#include "formats/mitsuba/parse_value.h"

namespace waylight::mitsuba {
namespace {

bool is_object(const Element& element) { return tag_rule(element.tag).kind == TagKind::object; }

const std::string& value_of(const Element& property, std::initializer_list<const char*> tags) {
  for (const char* tag : tags)
    if (property.tag == tag) return required_attribute(property, "value");
  fail_at(property, "should be a <{}>", *tags.begin());
}

}  // namespace

Properties::Properties(const Document& document, const Element& element)
    : document_(document), element_(element) {}

const Element* Properties::find(const std::string& name) {
  known_names_.insert(name);
  const Element* found = nullptr;
  for (const Element& child : element_.children) {
    if (child.name != name) continue;
    if (found) fail_at(child, "is already given by {}", found->where());
    found = &child;
  }
  return found;
}

const Element* Properties::follow(const Element& child) const {
  return child.tag == "ref" ? document_.ids.at(child.id) : &child;
}

bool Properties::has(const std::string& name) { return find(name) != nullptr; }

std::string Properties::tag(const std::string& name) {
  const Element* property = find(name);
  return property ? property->tag : "";
}

float Properties::number(const std::string& name, float otherwise) {
  const Element* property = find(name);
  if (!property) return otherwise;
  const std::string& text = value_of(*property, {"float", "integer"});
  return static_cast<float>(parse_number(*property, text));
}

int Properties::integer(const std::string& name, int otherwise) {
  const Element* property = find(name);
  return property ? parse_integer(*property, value_of(*property, {"integer"})) : otherwise;
}

bool Properties::boolean(const std::string& name, bool otherwise) {
  const Element* property = find(name);
  return property ? parse_boolean(*property, value_of(*property, {"boolean"})) : otherwise;
}

std::string Properties::text(const std::string& name, const std::string& otherwise) {
  const Element* property = find(name);
  return property ? value_of(*property, {"string"}) : otherwise;
}

Vec3 Properties::vector(const std::string& name, const Vec3& otherwise) {
  const Element* property = find(name);
  if (!property) return otherwise;
  if (property->tag != "vector" && property->tag != "point")
    fail_at(*property, "should be a <vector> or <point>");
  return parse_vector(*property, Eigen::Vector3d::Zero()).cast<float>();
}

Color Properties::color(const std::string& name, const Color& otherwise) {
  const Element* property = find(name);
  if (!property) return otherwise;
  if (const Element* nested = object(name))
    fail_at(*property, "is a <{}>, which is not supported in {}; give a colour", nested->tag,
            element_.where());
  return parse_color(document_, *property);
}

Mat4 Properties::transform(const std::string& name) {
  const Element* property = find(name);
  if (!property) return Mat4::Identity();
  if (property->tag != "transform") fail_at(*property, "should be a <transform>");
  return parse_transform(*property);
}

const Element* Properties::object(const std::string& name) {
  const Element* property = find(name);
  if (!property) return nullptr;
  const Element* target = follow(*property);
  return is_object(*target) ? target : nullptr;
}

std::vector<const Element*> Properties::objects(const std::string& tag) {
  known_tags_.insert(tag);
  std::vector<const Element*> found;
  for (const Element& child : element_.children)
    if (follow(child)->tag == tag) found.push_back(follow(child));
  return found;
}

void Properties::ignore(const std::vector<std::string>& names) {
  known_names_.insert(names.begin(), names.end());
}

void Properties::ignore_objects(const std::vector<std::string>& tags) {
  known_tags_.insert(tags.begin(), tags.end());
}

void Properties::finish() {
  const std::vector<std::string> names(known_names_.begin(), known_names_.end());
  for (const Element& child : element_.children) {
    const Element& target = *follow(child);
    if (known_tags_.count(target.tag)) continue;
    if (child.name.empty())
      fail_at(child, "a <{}> has no place in {}", target.tag, element_.where());
    if (!known_names_.count(child.name))
      fail_at(child, "{} has no property of that name{}", element_.where(),
              did_you_mean(child.name, names));
  }
}

}  // namespace waylight::mitsuba
