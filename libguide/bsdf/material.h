#pragma once
// Materials as a scene describes them: textured parameters, wrappers referring to other materials
// by index. `resolve` (bsdf/bsdf.h) turns one into lobes at a shading point.

#include <string>
#include <variant>

#include "libguide/image/texture.h"

namespace waylight {

enum class MicrofacetDistribution { ggx, beckmann };

struct DiffuseMaterial {
  Texture reflectance{0.5f};
};
struct ConductorMaterial {
  Color eta = Color::Zero(), k = Color::Ones();  // relative to the outside; `none` is 0 and 1
  Texture specular_reflectance{1.0f};
};
struct RoughConductorMaterial {
  Color eta = Color::Zero(), k = Color::Ones();
  Texture specular_reflectance{1.0f};
  Texture alpha_u{0.1f}, alpha_v{0.1f};
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
};
struct DielectricMaterial {
  float eta = 1.5046f;  // interior / exterior
  Texture specular_reflectance{1.0f}, specular_transmittance{1.0f};
};
struct ThinDielectricMaterial {
  float eta = 1.5046f;
  Texture specular_reflectance{1.0f}, specular_transmittance{1.0f};
};
struct RoughDielectricMaterial {
  float eta = 1.5046f;
  Texture specular_reflectance{1.0f}, specular_transmittance{1.0f};
  Texture alpha_u{0.1f}, alpha_v{0.1f};
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
};
struct PlasticMaterial {
  float eta = 1.49f;
  bool nonlinear = false;
  Texture diffuse_reflectance{0.5f}, specular_reflectance{1.0f};
};
struct RoughPlasticMaterial {
  float eta = 1.49f;
  bool nonlinear = false;
  Texture diffuse_reflectance{0.5f}, specular_reflectance{1.0f};
  Texture alpha{0.1f};
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
};
struct PhongMaterial {
  Texture diffuse_reflectance{0.5f}, specular_reflectance{0.2f};
  Texture exponent{30.0f};
};
struct WardMaterial {
  enum class Variant { ward, ward_duer, balanced };
  Variant variant = Variant::balanced;
  Texture diffuse_reflectance{0.5f}, specular_reflectance{0.2f};
  Texture alpha_u{0.1f}, alpha_v{0.1f};
};
struct NullMaterial {};  // index-matched: rays pass straight through

struct TwoSidedMaterial {
  int front = 0, back = 0;  // indices of materials
};
struct MaskMaterial {
  int nested = 0;
  Texture opacity{0.5f};
};
struct BlendMaterial {
  int first = 0, second = 0;
  Texture weight{0.5f};  // of the second
};
struct BumpMapMaterial {
  int nested = 0;
  Texture height;  // displacement in units of the world, scale included
};
struct NormalMapMaterial {
  int nested = 0;
  Texture normals;  // raw RGB in [0,1] of the tangent-space normal
};

using MaterialModel =
    std::variant<DiffuseMaterial, ConductorMaterial, RoughConductorMaterial, DielectricMaterial,
                 ThinDielectricMaterial, RoughDielectricMaterial, PlasticMaterial,
                 RoughPlasticMaterial, PhongMaterial, WardMaterial, NullMaterial, TwoSidedMaterial,
                 MaskMaterial, BlendMaterial, BumpMapMaterial, NormalMapMaterial>;

struct Material {
  std::string name;  // id in the scene file, or "<type>@line N" where it has none
  MaterialModel model;
};

// The Mitsuba name of the model: "diffuse", "roughconductor", ...
const char* material_kind(const Material& material);

}  // namespace waylight
