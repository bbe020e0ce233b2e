#include <gtest/gtest.h>

#include "libguide/base/error.h"
#include "libguide/bsdf/bsdf.h"

namespace waylight {
namespace {

using Materials = std::vector<Material>;

DiffuseMaterial grey(float value) { return {Texture(value)}; }

// The material at index 0 at a point of the plane z = 0.
ResolvedBsdf at(const Materials& materials, const Vec3& wo, const ShadingPoint& point = {}) {
  return resolve(materials, 0, point, wo.normalized(), TransportMode::radiance);
}

float reflected(const ResolvedBsdf& r, const Vec3& wo, const Vec3& wi) {
  return r.bsdf.eval(r.frame.to_local(wo.normalized()), r.frame.to_local(wi.normalized())).x();
}

const Vec3 kAbove(0.3f, 0.1f, 1), kBelow(0.2f, 0.4f, -1);

TEST(Resolve, OneSidedIsBlackFromBehind) {
  const Materials m = {{"a", grey(0.5f)}};
  EXPECT_NEAR(reflected(at(m, kAbove), kAbove, Vec3::UnitZ()), 0.5f * kInvPi, 1e-6f);
  EXPECT_EQ(reflected(at(m, kBelow), kBelow, -Vec3::UnitZ()), 0);
  EXPECT_GT(at(m, kBelow).frame.n.z(), 0);
}

TEST(Resolve, TwoSidedFlipsTheFrameAndTakesTheBack) {
  const Materials m = {{"t", TwoSidedMaterial{1, 2}}, {"f", grey(0.5f)}, {"b", grey(0.25f)}};
  EXPECT_NEAR(reflected(at(m, kAbove), kAbove, Vec3::UnitZ()), 0.5f * kInvPi, 1e-6f);
  const ResolvedBsdf back = at(m, kBelow);
  EXPECT_LT(back.frame.n.z(), 0);
  EXPECT_GT(back.frame.to_local(kBelow).z(), 0);
  EXPECT_NEAR(reflected(back, kBelow, -Vec3::UnitZ()), 0.25f * kInvPi, 1e-6f);
  EXPECT_NEAR(back.frame.s.cross(back.frame.t).dot(back.frame.n), 1, 1e-6f);
}

TEST(Resolve, MaskKeepsItsLobesAndShowsInOpacityOnly) {
  const Materials m = {{"m", MaskMaterial{1, Texture(0.25f)}}, {"d", grey(0.5f)}};
  EXPECT_FLOAT_EQ(opacity(m, 0, {0, 0}), 0.25f);
  EXPECT_TRUE(may_be_transparent(m, 0));
  EXPECT_FALSE(may_be_transparent(m, 1));
  EXPECT_NEAR(reflected(at(m, kAbove), kAbove, Vec3::UnitZ()), 0.5f * kInvPi, 1e-6f);
}

TEST(Resolve, BlendWithNullIsItsRestGivenThatTheRayMetIt) {
  const Materials m = {
      {"b", BlendMaterial{1, 2, Texture(0.75f)}}, {"d", grey(0.4f)}, {"n", NullMaterial{}}};
  EXPECT_FLOAT_EQ(opacity(m, 0, {0, 0}), 0.25f);
  EXPECT_NEAR(reflected(at(m, kAbove), kAbove, Vec3::UnitZ()), 0.4f * kInvPi, 1e-6f);
  EXPECT_EQ(at({{"n", NullMaterial{}}}, kAbove).bsdf.count(), 0);
}

TEST(Resolve, NestedBlendsMixByTheirWeights) {
  const Materials m = {{"outer", BlendMaterial{1, 2, Texture(0.25f)}},
                       {"a", grey(0.8f)},
                       {"inner", BlendMaterial{1, 3, Texture(0.5f)}},
                       {"b", grey(0.2f)}};
  const ResolvedBsdf r = at(m, kAbove);
  EXPECT_EQ(r.bsdf.count(), 3);
  EXPECT_NEAR(reflected(r, kAbove, Vec3::UnitZ()),
              (0.75f * 0.8f + 0.125f * 0.8f + 0.125f * 0.2f) * kInvPi, 1e-6f);
  EXPECT_NEAR(r.bsdf.mean_reflectance().x(), 0.725f, 1e-6f);
}

TEST(Resolve, BlendOfTwoSidedAndGlassInvertsTheGlassBehind) {
  const Materials m = {{"blend", BlendMaterial{1, 3, Texture(0.5f)}},
                       {"t", TwoSidedMaterial{2, 2}},
                       {"d", grey(0.5f)},
                       {"g", DielectricMaterial{1.5f}}};
  const Vec3 below = -Vec3::UnitZ();
  const ResolvedBsdf r = at(m, below);
  EXPECT_GT(r.bsdf.delta_prob(r.frame.to_local(below)), 0);
  const std::optional<BsdfSample> s = r.bsdf.sample_delta(r.frame.to_local(below), 0.99f);
  ASSERT_TRUE(s);
  EXPECT_FLOAT_EQ(s->eta, 1 / 1.5f);  // out of the glass
}

TEST(Resolve, CirclesOfWrappersAreErrors) {
  const Materials m = {{"loop", TwoSidedMaterial{0, 0}}};
  EXPECT_THROW(at(m, kAbove), Error);
  EXPECT_THROW(opacity(m, 0, {0, 0}), Error);
  EXPECT_THROW(may_be_transparent(m, 0), Error);
  EXPECT_THROW(resolve_mean(m, 0), Error);
}

TEST(Resolve, MoreLobesThanABsdfHoldsIsAnError) {
  const Texture half(0.5f);
  Materials m = {{"0", BlendMaterial{1, 4, half}},
                 {"1", BlendMaterial{2, 4, half}},
                 {"2", BlendMaterial{3, 4, half}},
                 {"3", BlendMaterial{4, 4, half}},
                 {"4", grey(0.5f)}};
  EXPECT_THROW(at(m, kAbove), Error);
  m[3].model = grey(0.5f);
  EXPECT_EQ(at(m, kAbove).bsdf.count(), 4);
}

Texture ramp(float slope) {  // height = slope * u over u in [0.1, 0.9]
  auto bitmap = std::make_shared<Bitmap>();
  bitmap->width = bitmap->height = 64;
  for (int i = 0; i < 64 * 64; ++i)
    bitmap->pixels.push_back(Color::Constant(slope * (i % 64 + 0.5f) / 64));
  Texture texture;
  texture.source = BitmapTexture{bitmap};
  return texture;
}

TEST(Resolve, BumpMapTiltsAgainstTheSlopeOnEitherHandednessAndSide) {
  const Materials m = {{"bump", BumpMapMaterial{1, ramp(0.5f)}}, {"d", grey(0.5f)}};
  const Vec3 expected = Vec3(-0.25f, 0, 1).normalized();  // dpdu = 2: dh/dx = 0.25
  for (float handedness : {1.0f, -1.0f}) {
    ShadingPoint point;
    point.uv = {0.5f, 0.5f};
    point.dpdu = 2 * Vec3::UnitX();
    point.dpdv = handedness * Vec3::UnitY();
    EXPECT_LT((at(m, kAbove, point).frame.n - expected).norm(), 1e-3f);
    EXPECT_LT((at(m, kBelow, point).frame.n - expected).norm(), 1e-3f);
  }
}

TEST(Resolve, NormalMapTurnsIntoTheTangentFrame) {
  const Vec3 tilt = Vec3(0.6f, 0, 0.8f);
  NormalMapMaterial map{1, {}};
  map.normals = Texture(Color((0.5f * (tilt + Vec3::Ones())).array()));
  const Materials m = {{"map", map}, {"d", grey(0.5f)}};
  ShadingPoint point;
  point.dpdu = Vec3::UnitY();
  EXPECT_LT((at(m, kAbove, point).frame.n - Vec3(0, 0.6f, 0.8f)).norm(), 1e-5f);
}

// Whatever the normals, wo is on the side of the frame on which it is of ng.
TEST(Resolve, NoBlackRimsWhereShadingNormalsTurnAway) {
  const Materials one = {{"d", grey(0.5f)}}, two = {{"t", TwoSidedMaterial{1, 1}}, {"d", grey(1)}};
  for (float tilt : {0.0f, 0.5f, 1.2f, 1.5f})
    for (float elevation : {1.5f, 0.8f, 0.1f, 1e-3f, -1e-3f, -0.4f, -1.5f}) {
      ShadingPoint point;
      point.ns = Vec3(std::sin(tilt), 0, std::cos(tilt));
      const Vec3 wo(-std::cos(elevation), 0, std::sin(elevation));
      for (const Materials& m : {one, two}) {
        const ResolvedBsdf r = at(m, wo, point);
        const float z = r.frame.to_local(wo).z();
        EXPECT_TRUE(r.frame.n.allFinite() && r.frame.s.allFinite() && r.frame.t.allFinite());
        EXPECT_NEAR(r.frame.n.norm(), 1, 1e-5f);
        const bool behind = m.size() == 1 && elevation < 0;
        EXPECT_GT(behind ? -z : z, 5e-4f) << tilt << " " << elevation;
      }
    }
}

TEST(Resolve, DegenerateTangentsAndTexturesGiveFiniteFrames) {
  const Materials m = {{"bump", BumpMapMaterial{1, ramp(1e30f)}},
                       {"map", NormalMapMaterial{2, Texture(0.5f)}},  // the zero vector
                       {"d", grey(std::nanf(""))}};
  ShadingPoint point;
  point.dpdu = point.dpdv = Vec3::Zero();
  const ResolvedBsdf r = at(m, kAbove, point);
  EXPECT_TRUE(r.frame.n.allFinite() && r.frame.s.allFinite());
  EXPECT_EQ(reflected(r, kAbove, Vec3::UnitZ()), 0);
}

TEST(Resolve, MeanUsesTextureMeans) {
  CheckerboardTexture board{Color::Zero(), Color::Ones()};
  Texture texture;
  texture.source = board;
  const Materials m = {{"d", DiffuseMaterial{texture}}};
  EXPECT_NEAR(resolve_mean(m, 0).mean_reflectance().x(), 0.5f, 1e-6f);
}

TEST(Resolve, IndexMatchedRoughGlassGoesStraightOn) {
  RoughDielectricMaterial glass;
  glass.eta = 1;
  const Materials m = {{"g", glass}};
  const Vec3 wo = kAbove.normalized();
  const ResolvedBsdf r = at(m, wo);
  const std::optional<BsdfSample> s = r.bsdf.sample_delta(r.frame.to_local(wo), 0.5f);
  ASSERT_TRUE(s);
  EXPECT_LT((r.frame.to_world(s->wi) + wo).norm(), 1e-6f);
  EXPECT_EQ(s->weight.x(), 1);
}

TEST(Resolve, ReflectancesBeyondOneAreHeldThere) {
  PhongMaterial phong;
  phong.diffuse_reflectance = Texture(0.8f);
  phong.specular_reflectance = Texture(0.8f);
  EXPECT_NEAR(resolve_mean(Materials{{"p", phong}}, 0).mean_reflectance().x(), 1, 1e-6f);
  EXPECT_NEAR(resolve_mean(Materials{{"d", grey(7)}}, 0).mean_reflectance().x(), 1, 1e-6f);
}

TEST(Resolve, KindsOfLobesAreKnown) {
  const auto mean = [](const MaterialModel& model) {
    return resolve_mean(Materials{{"m", model}}, 0);
  };
  EXPECT_TRUE(mean(DiffuseMaterial{}).has_smooth());
  EXPECT_FALSE(mean(ConductorMaterial{}).has_smooth());
  EXPECT_TRUE(mean(PlasticMaterial{}).has_smooth());
  EXPECT_FALSE(mean(DielectricMaterial{}).smooth_transmissive());
  EXPECT_TRUE(mean(RoughDielectricMaterial{}).smooth_transmissive());
  EXPECT_FALSE(mean(RoughPlasticMaterial{}).smooth_transmissive());
}

TEST(Material, KindsAreMitsubasNames) {
  EXPECT_STREQ(material_kind({"", DiffuseMaterial{}}), "diffuse");
  EXPECT_STREQ(material_kind({"", RoughPlasticMaterial{}}), "roughplastic");
  EXPECT_STREQ(material_kind({"", NullMaterial{}}), "null");
  EXPECT_STREQ(material_kind({"", BlendMaterial{}}), "blendbsdf");
  EXPECT_STREQ(material_kind({"", NormalMapMaterial{}}), "normalmap");
}

}  // namespace
}  // namespace waylight
