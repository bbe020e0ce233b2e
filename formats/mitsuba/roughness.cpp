#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/textures.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {
namespace {

// The old dialect's "phong" and "as" (anisotropic Phong) have the exponent 2 / alpha^2 - 2, with
// which they come close to Beckmann of the same alpha.
bool is_phong(const std::string& name) { return name == "phong" || name == "as"; }

MicrofacetDistribution distribution_property(ImportContext& context, Properties& properties) {
  static const std::map<std::string, MicrofacetDistribution> kDistributions = {
      {"ggx", MicrofacetDistribution::ggx}, {"beckmann", MicrofacetDistribution::beckmann}};
  const std::string name = properties.text("distribution", "beckmann");
  const Element& element = properties.element();
  if (!is_phong(name)) return choose(properties, "distribution", kDistributions, "beckmann");
  if (!context.options.lenient)
    fail_at(element, "distribution \"{}\" is not supported; \"beckmann\" of the same alpha is near",
            name);
  context.warn(fmt::format("{}: distribution \"{}\" taken as \"beckmann\" of the same alpha",
                           element.where(), name));
  return MicrofacetDistribution::beckmann;
}

}  // namespace

Roughness roughness_property(ImportContext& context, Properties& properties) {
  properties.boolean("sample_visible", true);  // always done
  if (properties.has("alpha") && (properties.has("alpha_u") || properties.has("alpha_v")))
    fail_at(properties.element(), "has alpha beside alpha_u or alpha_v; give one or the other");
  Roughness r;
  r.distribution = distribution_property(context, properties);
  const Texture alpha = texture_property(context, properties, "alpha", Texture(0.1f));
  r.alpha_u = texture_property(context, properties, "alpha_u", alpha);
  r.alpha_v = texture_property(context, properties, "alpha_v", alpha);
  return r;
}

void ignore_alpha(ImportContext& context, Properties& properties) {
  if (!context.document.old_dialect || !properties.has("alpha")) return;
  const Element& element = properties.element();
  context.warn(fmt::format("{}: alpha has no effect on a smooth material; \"rough{}\" would use it",
                           element.where(), element.type));
}

}  // namespace waylight::mitsuba
