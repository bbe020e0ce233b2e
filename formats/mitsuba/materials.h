#pragma once
// The importers of single materials, and the tables of measured constants they look names up in.

#include <optional>

#include "formats/mitsuba/import_context.h"

namespace waylight::mitsuba {

// Types that import_material knows.
std::vector<std::string> known_materials();

// material_plain.cpp
MaterialModel import_diffuse(ImportContext& context, Properties& properties);
MaterialModel import_phong(ImportContext& context, Properties& properties);
MaterialModel import_ward(ImportContext& context, Properties& properties);
MaterialModel import_null(ImportContext& context, Properties& properties);

// material_metal.cpp
MaterialModel import_conductor(ImportContext& context, Properties& properties);
MaterialModel import_rough_conductor(ImportContext& context, Properties& properties);

// material_dielectric.cpp
MaterialModel import_dielectric(ImportContext& context, Properties& properties);
MaterialModel import_thin_dielectric(ImportContext& context, Properties& properties);
MaterialModel import_rough_dielectric(ImportContext& context, Properties& properties);

// material_plastic.cpp
MaterialModel import_plastic(ImportContext& context, Properties& properties);
MaterialModel import_rough_plastic(ImportContext& context, Properties& properties);

// material_wrappers.cpp
MaterialModel import_two_sided(ImportContext& context, Properties& properties);
MaterialModel import_mask(ImportContext& context, Properties& properties);
MaterialModel import_blend(ImportContext& context, Properties& properties);
MaterialModel import_bump_map(ImportContext& context, Properties& properties);
MaterialModel import_normal_map(ImportContext& context, Properties& properties);

// What a material is made of; nothing where it is no wrapper.
std::vector<int> parts(const MaterialModel& model);
// Glass or nothing: seen from both sides, light passes through it.
bool is_interface(const MaterialModel& model);

// two_sided.cpp: what shapes show of one side only gets two that are alike. Each opaque part,
// inside masks, blends, bump and normal maps too, gives its place to a <twosided> around it.
void make_two_sided(SceneDescription& scene);

// roughness.cpp: `distribution`, `alpha`, `alpha_u`, `alpha_v`.
struct Roughness {
  MicrofacetDistribution distribution;
  Texture alpha_u, alpha_v;
};
Roughness roughness_property(ImportContext& context, Properties& properties);
// `alpha` of a smooth material: without meaning there, accepted by the old dialect.
void ignore_alpha(ImportContext& context, Properties& properties);

// ior_presets.cpp: a refractive index by number or by the name of a substance ("water", "bk7").
float ior_property(Properties& properties, const std::string& name, const std::string& otherwise);
// int_ior / ext_ior; outside is air unless said otherwise.
float relative_ior(Properties& properties, const std::string& inside);

// metal_presets.cpp: complex index of a metal by its symbol ("Au"), in linear sRGB.
struct ComplexIor {
  Color eta, k;
};
std::optional<ComplexIor> metal_preset(const std::string& name);
std::vector<std::string> known_metals();

}  // namespace waylight::mitsuba
