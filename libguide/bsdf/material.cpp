#include "libguide/bsdf/material.h"

#include <array>

namespace waylight {

const char* material_kind(const Material& material) {
  // In the order of MaterialModel.
  static constexpr std::array<const char*, std::variant_size_v<MaterialModel>> kNames = {
      "diffuse",    "conductor",      "roughconductor",
      "dielectric", "thindielectric", "roughdielectric",
      "plastic",    "roughplastic",   "phong",
      "ward",       "null",           "twosided",
      "mask",       "blendbsdf",      "bumpmap",
      "normalmap"};
  return kNames[material.model.index()];
}

}  // namespace waylight
