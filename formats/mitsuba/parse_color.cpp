#include <algorithm>

#include "formats/mitsuba/import_context.h"
#include "formats/mitsuba/parse_value.h"
#include "formats/srgb.h"

namespace waylight::mitsuba {
namespace {

Color from_srgb(const Color& c) {
  return {srgb_to_linear(c.x()), srgb_to_linear(c.y()), srgb_to_linear(c.z())};
}

// "#rrggbb", always in the curve of sRGB.
Color parse_hexadecimal(const Element& element, const std::string& text) {
  const bool well_formed =
      text.size() == 7 && text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!well_formed) fail_at(element, "\"{:.40}\" is no colour, write #rrggbb", text);
  Color encoded;
  for (int i = 0; i < 3; ++i)
    encoded[i] = static_cast<float>(std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16)) / 255;
  return from_srgb(encoded);
}

// One number or three.
Color parse_triple(const Element& element, const std::string& text) {
  const std::vector<double> numbers = parse_numbers(element, text);
  if (numbers.size() == 1) return Color::Constant(static_cast<float>(numbers[0]));
  if (numbers.size() != 3) fail_at(element, "has {} numbers, a colour has 1 or 3", numbers.size());
  return Eigen::Array3d(numbers[0], numbers[1], numbers[2]).cast<float>();
}

Color parse_samples(const Element& element, const std::string& text) {
  std::string spaced = text;
  for (char& c : spaced)
    if (c == ':') c = ' ';
  const std::vector<double> numbers = parse_numbers(element, spaced);
  std::vector<double> wavelengths, values;
  for (size_t i = 0; i < numbers.size(); ++i) (i % 2 ? values : wavelengths).push_back(numbers[i]);
  return color_of_samples(element, wavelengths, values);
}

Color parse_plain_spectrum(const Element& element) {
  const std::string& text = required_attribute(element, "value");
  return text.find(':') == std::string::npos ? parse_triple(element, text)
                                             : parse_samples(element, text);
}

// What a <spectrum> may have, beside an intent, depends on its type.
void check_attributes(const Element& element) {
  static const std::map<std::string, std::string> kRead = {
      {"", "value"}, {"uniform", "value"}, {"d65", "scale"}};
  const auto read = kRead.find(element.type);
  for (const auto& [name, value] : element.attributes)
    if (name != "intent" && (read == kRead.end() || name != read->second))
      fail_at(element, "takes no attribute \"{}\"; leave it out", name);
}

Color parse_spectrum(const Document& document, const Element& element) {
  if (element.attribute("filename"))
    fail_at(element, "spectra in files are not read; write the wavelength:value pairs here");
  const Color color = element.type.empty() ? parse_plain_spectrum(element)
                                           : parse_spectrum_plugin(document, element);
  check_attributes(element);
  return color;
}

Color parse_blackbody(const Element& element) {
  std::string temperature = required_attribute(element, "temperature");
  if (!temperature.empty() && (temperature.back() == 'K' || temperature.back() == 'k'))
    temperature.pop_back();
  const std::string* scale = element.attribute("scale");
  return color_of_blackbody(element, parse_number(element, temperature),
                            scale ? parse_number(element, *scale) : 1);
}

// The old dialect's `intent` tells how a colour becomes a spectrum; colours here stay colours.
void check_intent(const Element& element) {
  const std::vector<std::string> known = {"reflectance", "illuminant"};
  const std::string* intent = element.attribute("intent");
  if (intent && std::find(known.begin(), known.end(), *intent) == known.end())
    fail_at(element, "unknown intent \"{}\"{}", *intent, did_you_mean(*intent, known));
}

}  // namespace

Color color_of_samples(const Element& element, const std::vector<double>& wavelengths,
                       const std::vector<double>& values) {
  if (wavelengths.size() != values.size() || values.size() < 2)
    fail_at(element, "has {} wavelengths and {} values, it needs two or more pairs",
            wavelengths.size(), values.size());
  std::vector<std::pair<float, float>> samples;
  for (size_t i = 0; i < values.size(); ++i) {
    samples.emplace_back(static_cast<float>(wavelengths[i]), static_cast<float>(values[i]));
    if (i > 0 && !(wavelengths[i] > wavelengths[i - 1]))
      fail_at(element, "its wavelengths must increase, {} follows {}", wavelengths[i],
              wavelengths[i - 1]);
  }
  return spectrum_to_rgb(samples);
}

Color color_of_blackbody(const Element& element, double kelvin, double scale) {
  if (!(kelvin > 0)) fail_at(element, "its temperature must be above 0 K");
  return blackbody_rgb(static_cast<float>(kelvin), static_cast<float>(scale));
}

Color parse_color(const Document& document, const Element& element) {
  check_intent(element);
  if (element.tag == "blackbody") return parse_blackbody(element);
  if (element.tag == "spectrum") return parse_spectrum(document, element);
  const std::string& text = required_attribute(element, "value");
  if (element.tag == "float" || element.tag == "integer")
    return Color::Constant(static_cast<float>(parse_number(element, text)));
  if (element.tag != "rgb" && element.tag != "srgb" && element.tag != "color")
    fail_at(element, "is no colour");
  if (text.starts_with('#')) return parse_hexadecimal(element, text);
  const Color color = parse_triple(element, text);
  return element.tag == "srgb" ? from_srgb(color) : color;
}

}  // namespace waylight::mitsuba
