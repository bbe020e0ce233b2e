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
Color parse_color(const Document& document, const Element& element);

// Of a spectrum given by samples: wavelengths in nm that increase, two or more.
Color color_of_samples(const Element& element, const std::vector<double>& wavelengths,
                       const std::vector<double>& values);
Color color_of_blackbody(const Element& element, double kelvin, double scale);

// spectrum_plugins.cpp: the new dialect's <spectrum type="...">.
Color parse_spectrum_plugin(const Document& document, const Element& element);

// <transform>: the first step is applied first.
Mat4 parse_transform(const Element& element);

}  // namespace waylight::mitsuba
