// What --two-sided makes of the materials of a scene.

#include "formats/mitsuba/scene_texts.h"
#include "libguide/bsdf/bsdf.h"

namespace waylight {
namespace {

const std::string kGrey = "<bsdf type=\"diffuse\"/>";
const std::string kGlass = "<bsdf type=\"dielectric\"/>";

class TwoSided : public testing::MitsubaScenes {
 protected:
  TwoSided() { options_.two_sided = true; }

  static std::string with_type(const std::string& type, const std::string& body = "") {
    return "<bsdf type=\"" + type + "\">" + body + "</bsdf>";
  }
  SceneDescription painted(const std::string& bsdf) {
    return import("<shape type=\"sphere\">" + bsdf + "</shape>");
  }
  // How much a surface of the only shape reflects of light from straight above it, seen from there.
  static float reflected(const SceneDescription& scene, float side) {
    ShadingPoint point;
    point.ng = point.ns = Vec3(0, 0, 1), point.dpdu = Vec3(1, 0, 0), point.dpdv = Vec3(0, 1, 0);
    const Vec3 wo = Vec3(0.1f, 0.2f, side).normalized();
    const ResolvedBsdf resolved =
        resolve(scene.materials, scene.shapes[0].material, point, wo, TransportMode::radiance);
    const Vec3 local = resolved.frame.to_local(wo);
    return resolved.bsdf.eval(local, local).mean();
  }
};

TEST_F(TwoSided, OpaqueMaterialsReflectOnBothSides) {
  for (const char* type :
       {"diffuse", "roughconductor", "plastic", "roughplastic", "phong", "ward"}) {
    const SceneDescription scene = painted(with_type(type));
    EXPECT_GT(reflected(scene, 1), 0) << type;
    EXPECT_FLOAT_EQ(reflected(scene, 1), reflected(scene, -1)) << type;
  }
}

TEST_F(TwoSided, WithoutTheOptionTheBackIsBlack) {
  options_.two_sided = false;
  const SceneDescription scene = painted(kGrey);
  EXPECT_GT(reflected(scene, 1), 0);
  EXPECT_EQ(reflected(scene, -1), 0);
}

TEST_F(TwoSided, InsideOtherMaterialsTooOpaquePartsReflectOnBothSides) {
  const std::string height = "<texture type=\"checkerboard\"/>";
  for (const std::string& bsdf :
       {with_type("mask", kGrey), with_type("bumpmap", height + kGrey),
        with_type("blendbsdf", kGrey + kGlass),
        with_type("mask", with_type("bumpmap", height + with_type("blendbsdf", kGrey + kGrey)))}) {
    const SceneDescription scene = painted(bsdf);
    EXPECT_GT(reflected(scene, 1), 0) << bsdf;
    EXPECT_FLOAT_EQ(reflected(scene, 1), reflected(scene, -1)) << bsdf;
  }
}

TEST_F(TwoSided, WhatHasTwoSidesOrLetsLightThroughStays) {
  for (const std::string& bsdf :
       {with_type("twosided", kGrey), kGlass, with_type("thindielectric"),
        with_type("roughdielectric"), with_type("null"), with_type("mask", kGlass),
        with_type("blendbsdf", kGlass + kGlass)}) {
    const SceneDescription two = painted(bsdf);
    options_.two_sided = false;
    EXPECT_TRUE(two.hash == painted(bsdf).hash) << bsdf;
    options_.two_sided = true;
  }
}

TEST_F(TwoSided, SharedMaterialsAreWrappedOnceUnderTheirName) {
  const std::string ref = "<ref id=\"wall\"/></shape>";
  const SceneDescription scene =
      import("<bsdf type=\"diffuse\" id=\"wall\"/><shape type=\"cube\">" + ref +
             "<shape type=\"sphere\">" + ref + "<shape type=\"disk\"/>");
  EXPECT_EQ(scene.materials.size(), 4u);  // the wall and the default of the disk
  EXPECT_EQ(scene.shapes[0].material, scene.shapes[1].material);
  EXPECT_EQ(scene.materials[scene.shapes[0].material].name, "wall");
}

TEST_F(TwoSided, ChangesTheHashSoThatCachesOfTheOtherSceneAreRefused) {
  const SceneHash two = painted(kGrey).hash;
  options_.two_sided = false;
  EXPECT_FALSE(two == painted(kGrey).hash);
}

}  // namespace
}  // namespace waylight
