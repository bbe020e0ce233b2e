// <spectrum type="...">: as in Mitsuba's RGB modes, with samples and black bodies, which these do
// not have, brought to colours as <spectrum value="400:1, ..."> and <blackbody> are.

#include "formats/mitsuba/parse_value.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// A property, or the attribute of that name.
float number(Properties& properties, const std::string& name, float otherwise) {
  const std::string* attribute = properties.element().attribute(name);
  if (!attribute) return properties.number(name, otherwise);
  return static_cast<float>(parse_number(properties.element(), *attribute));
}

std::vector<double> numbers(Properties& properties, const std::string& name) {
  if (!properties.has(name)) fail_at(properties.element(), "needs a <string name=\"{}\">", name);
  return parse_numbers(properties.element(), properties.text(name, ""));
}

// Under its name in Mitsuba 3, or the one of early releases.
double end_of_range(Properties& properties, const std::string& end) {
  const std::string name = fmt::format("wavelength_{}", end),
                    before = fmt::format("lambda_{}", end);
  if (!properties.has(name) && !properties.has(before))
    fail_at(properties.element(), "needs a <float name=\"{}\">", name);
  return properties.number(name, properties.number(before, 0));
}

Color uniform(Properties& properties) {
  for (const char* end : {"min", "max"})  // for sampling wavelengths only
    properties.ignore({fmt::format("wavelength_{}", end), fmt::format("lambda_{}", end)});
  return Color::Constant(number(properties, "value", 1));
}

Color d65(Properties& properties) {
  return number(properties, "scale", 1) * properties.color("color", Color::Ones());
}

Color blackbody(Properties& properties) {
  if (!properties.has("temperature"))
    fail_at(properties.element(), "needs a <float name=\"temperature\">");
  return color_of_blackbody(properties.element(), properties.number("temperature", 0), 1);
}

Color irregular(Properties& properties) {
  return color_of_samples(properties.element(), numbers(properties, "wavelengths"),
                          numbers(properties, "values"));
}

Color regular(Properties& properties) {
  const double first = end_of_range(properties, "min"), last = end_of_range(properties, "max");
  const std::vector<double> values = numbers(properties, "values");
  std::vector<double> wavelengths;
  for (size_t i = 0; i < values.size(); ++i)
    wavelengths.push_back(std::lerp(first, last, double(i) / double(values.size() - 1)));
  return color_of_samples(properties.element(), wavelengths, values);
}

using SpectrumImporter = Color (*)(Properties&);
const std::map<std::string, SpectrumImporter> kImporters = {{"uniform", uniform},
                                                            {"d65", d65},
                                                            {"blackbody", blackbody},
                                                            {"irregular", irregular},
                                                            {"regular", regular}};

}  // namespace

Color parse_spectrum_plugin(const Document& document, const Element& element) {
  Properties properties(document, element);
  const SpectrumImporter importer = importer_of(element, kImporters, "spectrum");
  const Color color = importer(properties);
  properties.finish();
  return color;
}

}  // namespace waylight::mitsuba
