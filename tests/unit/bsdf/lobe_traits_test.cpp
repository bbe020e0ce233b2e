#include "libguide/bsdf/lobe_traits.h"

#include <gtest/gtest.h>

#include "libguide/bsdf/bsdf.h"

namespace waylight {
namespace {

// Where the trait were missing, guided paths would not look their cells up.
TEST(LobeTraits, AreSmoothWhereTheResolvedBsdfHasADensity) {
  const std::vector<MaterialModel> models = {
      DiffuseMaterial(),       ConductorMaterial(),      RoughConductorMaterial(),
      DielectricMaterial(),    ThinDielectricMaterial(), RoughDielectricMaterial(),
      PlasticMaterial(),       RoughPlasticMaterial(),   PhongMaterial(),
      WardMaterial(),          NullMaterial(),           TwoSidedMaterial{0, 0},
      TwoSidedMaterial{1, 1},  MaskMaterial{1},          MaskMaterial{0},
      BlendMaterial{1, 0},     BlendMaterial{1, 3},      BumpMapMaterial{0, {}},
      NormalMapMaterial{1, {}}};
  std::vector<Material> materials;
  for (const MaterialModel& model : models) materials.push_back({"", model});
  int smooth = 0;
  for (int m = 0; m < static_cast<int>(materials.size()); ++m) {
    const bool has_density = resolve_mean(materials, m).has_smooth();
    EXPECT_EQ(lobe_traits(materials, m).smooth, has_density) << material_kind(materials[m]) << m;
    smooth += has_density;
  }
  EXPECT_EQ(smooth, 11);
}

}  // namespace
}  // namespace waylight
