#pragma once
// Every lobe at several parameters, and the directions it is tested from.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "libguide/bsdf/bsdf.h"

namespace waylight::testing {

struct LobeCase {
  std::string name;
  Lobe lobe;
  bool both_sides = false;
  bool lossless_when_smooth = false;  // white, and only shadowing loses energy
};

inline Microfacet facets(float alpha_u, float alpha_v, MicrofacetDistribution kind) {
  return {alpha_u, alpha_v, kind};
}

inline Plastic plastic(const Color& rho, float eta, bool nonlinear) {
  const float internal = fresnel_diffuse_reflectance(1 / eta);
  return {eta, internal, coated_diffuse(rho, internal, eta, nonlinear), Color::Ones()};
}

inline RoughPlastic rough_plastic(const Color& rho, float eta, float alpha,
                                  MicrofacetDistribution kind) {
  const RoughTransmittance& table = rough_transmittance(kind, eta);
  const RoughTransmittance::Row row = table.row(alpha);
  return {eta,           coated_diffuse(rho, table.internal_reflectance(row), eta, true),
          Color::Ones(), facets(alpha, alpha, kind),
          &table,        row};
}

// Lobes with a density; white where they can be, so that they serve as a furnace.
inline std::vector<LobeCase> smooth_lobes() {
  const Color white = Color::Ones(), half = Color::Constant(0.5f);
  const Color none_eta = Color::Zero(), none_k = Color::Constant(1e6f);
  std::vector<LobeCase> cases = {{"diffuse", Diffuse{white}, false, true}};
  for (MicrofacetDistribution kind :
       {MicrofacetDistribution::ggx, MicrofacetDistribution::beckmann}) {
    const std::string tag = kind == MicrofacetDistribution::ggx ? " ggx" : " beckmann";
    for (const auto& [u, v] : std::vector<std::pair<float, float>>{
             {0.001f, 0.001f}, {0.02f, 0.02f}, {0.3f, 0.3f}, {1, 1}, {0.05f, 0.5f}}) {
      const std::string name = tag + fmt::format(" {} {}", u, v);
      cases.push_back({"roughconductor" + name,
                       RoughConductor{none_eta, none_k, white, facets(u, v, kind)}, false, true});
      if (u == 0.001f) continue;  // the same normals as the conductor's
      for (TransportMode mode : {TransportMode::radiance, TransportMode::importance})
        cases.push_back({"roughdielectric" + name +
                             (mode == TransportMode::radiance ? " radiance" : " importance"),
                         RoughDielectric{1.5f, white, white, facets(u, v, kind), mode}, true,
                         mode == TransportMode::importance});
    }
    for (float alpha : {0.01f, 0.1f, 0.5f})
      cases.push_back({"roughplastic" + tag + fmt::format(" {}", alpha),
                       rough_plastic(white, 1.49f, alpha, kind)});
  }
  cases.push_back({"plastic", plastic(Color(0.9f, 0.5f, 0.1f), 1.49f, true)});
  cases.push_back({"plastic linear", plastic(white, 1.9f, false)});
  for (float exponent : {0.0f, 30.0f, 3000.0f})
    cases.push_back({fmt::format("phong {}", exponent), Phong{half, half, exponent}});
  cases.push_back({"phong 1e6", Phong{Color::Zero(), white, 1e6f}});
  for (Ward::Variant variant :
       {Ward::Variant::ward, Ward::Variant::ward_duer, Ward::Variant::balanced})
    for (const auto& [u, v] :
         std::vector<std::pair<float, float>>{{0.02f, 0.02f}, {0.2f, 0.2f}, {0.05f, 0.4f}})
      cases.push_back(
          {fmt::format("ward {} {} {}", int(variant), u, v), Ward{half, half, u, v, variant}});
  return cases;
}

inline std::vector<LobeCase> delta_lobes() {
  const Color white = Color::Ones();
  return {
      {"mirror", Conductor{Color::Zero(), Color::Constant(1e6f), white}, false, true},
      {"gold", Conductor{Color(0.143f, 0.375f, 1.442f), Color(3.983f, 2.386f, 1.603f), white}},
      {"glass radiance", Dielectric{1.5f, white, white, TransportMode::radiance}, true},
      {"glass importance", Dielectric{1.5f, white, white, TransportMode::importance}, true, true},
      {"tinted glass",
       Dielectric{1.33f, Color(1, 0.5f, 0.2f), Color(0.1f, 0.4f, 0.9f), TransportMode::importance},
       true},
      {"pane", ThinDielectric{1.5f, white, white}, true, true},
      {"plastic", plastic(Color(0.9f, 0.5f, 0.1f), 1.49f, true)}};
}

inline Bsdf bsdf_of(const Lobe& lobe, float weight = 1) {
  Bsdf bsdf;
  bsdf.add(lobe, weight);
  return bsdf;
}

inline Vec3 direction(float degrees, float azimuth) {
  const float theta = degrees * kPi / 180;
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

inline std::vector<Vec3> directions(bool both_sides) {
  std::vector<Vec3> result = {direction(0, 0), direction(35, 0.4f), direction(65, 2),
                              direction(85, -1.2f)};
  if (both_sides) {
    result.push_back(direction(180, 0));
    result.push_back(direction(150, 1));
    result.push_back(direction(120, -2));
  }
  return result;
}

}  // namespace waylight::testing
