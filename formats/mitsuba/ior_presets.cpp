#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// Real refractive indices at the sodium line (589 nm), as both dialects name them.
const std::map<std::string, float> kIndices = {
    {"vacuum", 1.0f},      {"helium", 1.000036f},        {"hydrogen", 1.000132f},
    {"air", 1.000277f},    {"carbon dioxide", 1.00045f}, {"water", 1.3330f},
    {"acetone", 1.36f},    {"ethanol", 1.361f},          {"carbon tetrachloride", 1.461f},
    {"glycerol", 1.4729f}, {"benzene", 1.501f},          {"silicone oil", 1.52045f},
    {"bromine", 1.661f},   {"water ice", 1.31f},         {"fused quartz", 1.458f},
    {"pyrex", 1.470f},     {"acrylic glass", 1.49f},     {"polypropylene", 1.49f},
    {"bk7", 1.5046f},      {"sodium chloride", 1.544f},  {"amber", 1.55f},
    {"pet", 1.5750f},      {"diamond", 2.419f}};

float named_ior(const Element& element, std::string substance) {
  for (char& c : substance) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = kIndices.find(substance);
  if (found != kIndices.end()) return found->second;
  fail_at(element, "unknown substance \"{}\"; give its refractive index as <float>{}", substance,
          did_you_mean(substance, names_of(kIndices)));
}

}  // namespace

float ior_property(Properties& properties, const std::string& name, const std::string& otherwise) {
  const std::string tag = properties.tag(name);
  if (tag.empty() || tag == "string")
    return named_ior(properties.element(), properties.text(name, otherwise));
  const float value = properties.number(name, 1);
  if (!(value > 0)) fail_at(properties.element(), "its {} is {}, it must be above 0", name, value);
  return value;
}

float relative_ior(Properties& properties, const std::string& inside) {
  return ior_property(properties, "int_ior", inside) / ior_property(properties, "ext_ior", "air");
}

}  // namespace waylight::mitsuba
