#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// Without a word about the metal the old dialect takes copper, the new one a perfect mirror.
std::string preset_name(ImportContext& context, Properties& properties) {
  const bool old = context.document.old_dialect;
  const std::string name = properties.text("material", old ? "Cu" : "none");
  const bool measured = properties.has("eta") || properties.has("k");
  if (measured && properties.has("material") && name != "none" && !old)
    fail_at(properties.element(), "has a material beside eta or k; give one or the other");
  return name;
}

// Relative to the outside.
ComplexIor complex_ior(ImportContext& context, Properties& properties) {
  const Element& element = properties.element();
  const std::string name = preset_name(context, properties);
  const std::optional<ComplexIor> preset = metal_preset(name);
  if (!preset)
    fail_at(element, "unknown metal \"{}\"; give eta and k instead{}", name,
            did_you_mean(name, known_metals()));
  const float outside =
      ior_property(properties, "ext_eta", context.document.old_dialect ? "air" : "vacuum");
  const ComplexIor ior = {properties.color("eta", preset->eta) / outside,
                          properties.color("k", preset->k) / outside};
  if (ior.eta.minCoeff() < 0 || ior.k.minCoeff() < 0) fail_at(element, "its eta or k is negative");
  return ior;
}

}  // namespace

MaterialModel import_conductor(ImportContext& context, Properties& properties) {
  ignore_alpha(context, properties);
  const ComplexIor ior = complex_ior(context, properties);
  return ConductorMaterial{
      ior.eta, ior.k,
      reflectance_property(context, properties, "specular_reflectance", Texture(1.0f))};
}

MaterialModel import_rough_conductor(ImportContext& context, Properties& properties) {
  const ComplexIor ior = complex_ior(context, properties);
  const Roughness r = roughness_property(context, properties);
  return RoughConductorMaterial{
      ior.eta,
      ior.k,
      reflectance_property(context, properties, "specular_reflectance", Texture(1.0f)),
      r.alpha_u,
      r.alpha_v,
      r.distribution};
}

}  // namespace waylight::mitsuba
