#pragma once
// What may stand in a scene file, and how the names of the old dialect are spelled in the new one.

#include <string>
#include <vector>

namespace waylight::mitsuba {

enum class TagKind {
  object,     // has a type: <shape>, <bsdf>
  value,      // a named property: <float>, <rgb>, <transform>
  step,       // of a transform: <rotate>
  reference,  // <ref>
  directive,  // gone after parsing: <default>, <include>, <path>, <alias>
  ignored,    // without meaning for an image: <mode>, <hide>
  unknown
};

struct TagRule {
  TagKind kind = TagKind::unknown;
  std::vector<std::string> attributes;  // beside name, type and id, those that it may have
};

const TagRule& tag_rule(const std::string& tag);
std::vector<std::string> known_tags();

// Tags that had another name in some version: lookAt, luminaire, camera.
std::string modern_tag(const std::string& tag);
// "toWorld" -> "to_world", "intIOR" -> "int_ior", "alphaU" -> "alpha_u"
std::string snake_case(const std::string& camel_case);

}  // namespace waylight::mitsuba
