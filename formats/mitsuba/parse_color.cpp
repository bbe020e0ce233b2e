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
  std::vector<std::pair<float, float>> samples;
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) {
    samples.emplace_back(static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1]));
    if (i > 0 && !(numbers[i] > numbers[i - 2]))
      fail_at(element, "its wavelengths must increase, {} follows {}", numbers[i], numbers[i - 2]);
  }
  if (numbers.size() % 2 || samples.size() < 2)
    fail_at(element, "needs two or more wavelength:value pairs");
  return spectrum_to_rgb(samples);
}

// Mitsuba 3's <spectrum type="..."> for what has a plain colour.
Color parse_spectrum_plugin(const Element& element) {
  if (element.type != "d65" && element.type != "uniform")
    fail_at(element, "unknown spectrum; write \"uniform\", \"d65\" or <rgb>");
  const std::string* scale = element.attribute(element.type == "d65" ? "scale" : "value");
  return Color::Constant(scale ? static_cast<float>(parse_number(element, *scale)) : 1.0f);
}

Color parse_spectrum(const Element& element) {
  if (!element.type.empty()) return parse_spectrum_plugin(element);
  if (element.attribute("filename"))
    fail_at(element, "spectra in files are not read; write the wavelength:value pairs here");
  const std::string& text = required_attribute(element, "value");
  return text.find(':') == std::string::npos ? parse_triple(element, text)
                                             : parse_samples(element, text);
}

Color parse_blackbody(const Element& element) {
  std::string temperature = required_attribute(element, "temperature");
  if (!temperature.empty() && (temperature.back() == 'K' || temperature.back() == 'k'))
    temperature.pop_back();
  const float kelvin = static_cast<float>(parse_number(element, temperature));
  if (!(kelvin > 0)) fail_at(element, "its temperature must be above 0 K");
  const std::string* scale = element.attribute("scale");
  return blackbody_rgb(kelvin, scale ? static_cast<float>(parse_number(element, *scale)) : 1.0f);
}

}  // namespace

Color parse_color(const Element& element) {
  if (element.tag == "blackbody") return parse_blackbody(element);
  if (element.tag == "spectrum") return parse_spectrum(element);
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
