#pragma once
// Typed access to the properties of one element. Each accessor marks its name as known whether or
// not it is there; finish() refuses what nobody asked for.

#include <optional>
#include <set>

#include "formats/mitsuba/element.h"
#include "libguide/math/types.h"

namespace waylight::mitsuba {

class Properties {
 public:
  Properties(const Document& document, const Element& element);

  const Element& element() const { return element_; }
  bool has(const std::string& name);
  // Tag of the property of that name: "float", "string", "rgb", "texture", "ref"; empty when it is
  // not there. For properties that may be of several kinds.
  std::string tag(const std::string& name);

  // All throw Error (file, line, element) for a value of the wrong kind, NaN or infinity.
  float number(const std::string& name, float otherwise);
  int integer(const std::string& name, int otherwise);
  bool boolean(const std::string& name, bool otherwise);
  std::string text(const std::string& name, const std::string& otherwise);
  Vec3 vector(const std::string& name, const Vec3& otherwise);  // <vector>, <point>
  // <rgb>, <srgb>, <spectrum>, <blackbody>, <color>, <float>: linear sRGB.
  Color color(const std::string& name, const Color& otherwise);
  // Row-major product of the transform's steps, the first applied first.
  Mat4 transform(const std::string& name);

  // A nested object (<texture>, <bsdf>, <medium>, ...) of that property name, <ref>s followed;
  // nullptr when there is none, or when the property is a plain value.
  const Element* object(const std::string& name);
  // All nested objects of a tag, <ref>s followed, named or not, in file order.
  std::vector<const Element*> objects(const std::string& tag);

  // Accepted without effect.
  void ignore(const std::vector<std::string>& names);
  void ignore_objects(const std::vector<std::string>& tags);

  // Throws Error for a property or nested object that no accessor has named, with the nearest known
  // name.
  void finish();

 private:
  const Element* find(const std::string& name);
  const Element* follow(const Element& child) const;  // what a <ref> stands for

  const Document& document_;
  const Element& element_;
  std::set<std::string> known_names_, known_tags_;
};

}  // namespace waylight::mitsuba
