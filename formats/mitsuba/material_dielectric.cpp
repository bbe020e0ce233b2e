#include "formats/mitsuba/materials.h"

namespace waylight::mitsuba {
namespace {

struct Glass {
  float eta;
  Texture reflectance, transmittance;
};

Glass glass(ImportContext& context, Properties& properties) {
  return {relative_ior(properties, "bk7"),
          reflectance_property(context, properties, "specular_reflectance", Texture(1.0f)),
          reflectance_property(context, properties, "specular_transmittance", Texture(1.0f))};
}

}  // namespace

MaterialModel import_dielectric(ImportContext& context, Properties& properties) {
  ignore_alpha(context, properties);
  const Glass g = glass(context, properties);
  return DielectricMaterial{g.eta, g.reflectance, g.transmittance};
}

MaterialModel import_thin_dielectric(ImportContext& context, Properties& properties) {
  const Glass g = glass(context, properties);
  return ThinDielectricMaterial{g.eta, g.reflectance, g.transmittance};
}

MaterialModel import_rough_dielectric(ImportContext& context, Properties& properties) {
  const Glass g = glass(context, properties);
  const Roughness r = roughness_property(context, properties);
  return RoughDielectricMaterial{g.eta,     g.reflectance, g.transmittance,
                                 r.alpha_u, r.alpha_v,     r.distribution};
}

}  // namespace waylight::mitsuba
