// Materials of opaque surfaces without a Fresnel term, and none at all.

#include "formats/mitsuba/materials.h"
#include "formats/mitsuba/textures.h"
#include "formats/mitsuba/types.h"

namespace waylight::mitsuba {

MaterialModel import_diffuse(ImportContext& context, Properties& properties) {
  const DiffuseMaterial m;
  // Both names are the old dialect's.
  const Texture alias =
      reflectance_property(context, properties, "diffuse_reflectance", m.reflectance);
  return DiffuseMaterial{reflectance_property(context, properties, "reflectance", alias)};
}

MaterialModel import_phong(ImportContext& context, Properties& properties) {
  PhongMaterial m;
  m.diffuse_reflectance =
      reflectance_property(context, properties, "diffuse_reflectance", m.diffuse_reflectance);
  m.specular_reflectance =
      reflectance_property(context, properties, "specular_reflectance", m.specular_reflectance);
  m.exponent = texture_property(context, properties, "exponent", m.exponent);
  return m;
}

MaterialModel import_ward(ImportContext& context, Properties& properties) {
  static const std::map<std::string, WardMaterial::Variant> kVariants = {
      {"ward", WardMaterial::Variant::ward},
      {"ward-duer", WardMaterial::Variant::ward_duer},
      {"balanced", WardMaterial::Variant::balanced}};
  WardMaterial m;
  m.variant = choose(properties, "variant", kVariants, "balanced");
  m.diffuse_reflectance =
      reflectance_property(context, properties, "diffuse_reflectance", m.diffuse_reflectance);
  m.specular_reflectance =
      reflectance_property(context, properties, "specular_reflectance", m.specular_reflectance);
  const Texture alpha = texture_property(context, properties, "alpha", m.alpha_u);
  m.alpha_u = texture_property(context, properties, "alpha_u", alpha);
  m.alpha_v = texture_property(context, properties, "alpha_v", alpha);
  return m;
}

MaterialModel import_null(ImportContext& /*context*/, Properties& /*properties*/) {
  return NullMaterial{};
}

}  // namespace waylight::mitsuba
