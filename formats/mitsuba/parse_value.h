#pragma once
// From the text of attributes to numbers, the same in every locale.

#include "formats/mitsuba/element.h"
#include "libguide/math/types.h"

namespace waylight::mitsuba {

// All throw Error naming the element for what is no finite number.
double parse_number(const Element& element, std::string_view text);
// Separated by commas or blanks.
std::vector<double> parse_numbers(const Element& element, std::string_view text);
int parse_integer(const Element& element, std::string_view text);
bool parse_boolean(const Element& element, std::string_view text);  // "true" or "false"

// The attribute; Error when the element does not have it.
const std::string& required_attribute(const Element& element, const std::string& key);

// x, y and z where given, else the one or three numbers of `value`, else `otherwise`.
Eigen::Vector3d parse_vector(const Element& element, const Eigen::Vector3d& otherwise);

// <rgb>, <srgb>, <color>, <spectrum>, <blackbody>, <float>, <integer> in linear sRGB.
Color parse_color(const Element& element);

// <transform>: the first step is applied first.
Mat4 parse_transform(const Element& element);

}  // namespace waylight::mitsuba
