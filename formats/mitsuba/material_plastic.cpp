#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/textures.h"

namespace waylight::mitsuba {
namespace {

// What both plastics have.
template <typename Plastic>
void import_coat(ImportContext& context, Properties& properties, Plastic& m) {
  m.eta = relative_ior(properties, "polypropylene");
  if (!(m.eta > 1))
    fail_at(properties.element(), "its int_ior must be above its ext_ior, the coat is denser");
  m.nonlinear = properties.boolean("nonlinear", false);
  m.diffuse_reflectance =
      reflectance_property(context, properties, "diffuse_reflectance", Texture(0.5f));
  m.specular_reflectance =
      reflectance_property(context, properties, "specular_reflectance", Texture(1.0f));
}

}  // namespace

MaterialModel import_plastic(ImportContext& context, Properties& properties) {
  ignore_alpha(context, properties);
  PlasticMaterial m;
  import_coat(context, properties, m);
  return m;
}

MaterialModel import_rough_plastic(ImportContext& context, Properties& properties) {
  RoughPlasticMaterial m;
  import_coat(context, properties, m);
  if (properties.has("alpha_u") || properties.has("alpha_v"))
    fail_at(properties.element(), "is isotropic; give alpha instead of alpha_u and alpha_v");
  const Roughness r = roughness_property(context, properties);
  m.alpha = r.alpha_u;
  m.distribution = r.distribution;
  return m;
}

}  // namespace waylight::mitsuba
