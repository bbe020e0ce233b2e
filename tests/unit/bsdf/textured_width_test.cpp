#include "libguide/bsdf/textured_width.h"

#include <gtest/gtest.h>

namespace waylight {
namespace {

Texture board(float a, float b) {
  Texture texture;
  texture.source = CheckerboardTexture{Color::Constant(a), Color::Constant(b)};
  return texture;
}

RoughConductorMaterial metal(const Texture& u, const Texture& v) {
  RoughConductorMaterial m;
  m.alpha_u = u, m.alpha_v = v;
  return m;
}

std::vector<Material> materials_of(const std::vector<MaterialModel>& models) {
  std::vector<Material> materials;
  for (const MaterialModel& model : models) materials.push_back({"m", model});
  return materials;
}

bool has_width(const std::vector<MaterialModel>& models) {
  return lobe_width(materials_of(models), static_cast<int>(models.size()) - 1).has_value();
}

void expect_range(const std::vector<MaterialModel>& models, float least, float largest) {
  const std::vector<Material> materials = materials_of(models);
  const std::optional<LobeWidth> width = lobe_width(materials, static_cast<int>(models.size()) - 1);
  ASSERT_TRUE(width);
  EXPECT_FLOAT_EQ(width->range().least, least);
  EXPECT_FLOAT_EQ(width->range().largest, largest);
  EXPECT_FLOAT_EQ(width->at({0.1f, 0.1f}), largest);
  EXPECT_FLOAT_EQ(width->at({0.6f, 0.1f}), least);
}

TEST(LobeWidth, IsThatOfTheTexture) {
  const Texture alpha = board(0.4f, 0.05f);
  expect_range({metal(alpha, alpha)}, 0.05f, 0.4f);
  RoughPlasticMaterial plastic;
  plastic.alpha = alpha;
  expect_range({plastic}, 0.05f, 0.4f);
  PhongMaterial phong;
  phong.exponent = board(0, 198);
  expect_range({phong}, 0.1f, 1);
}

TEST(LobeWidth, OfABitmapGoesFromItsLeastToItsLargestPixel) {
  Bitmap bitmap;
  bitmap.width = 3, bitmap.height = 1;
  bitmap.pixels = {Color::Constant(0.2f), Color(0.1f, 0.2f, 0.3f), Color::Constant(0.5f)};
  Texture alpha;
  alpha.source = BitmapTexture{std::make_shared<Bitmap>(bitmap)};
  alpha.scale = 0.5f;
  const std::vector<Material> materials = materials_of({metal(alpha, alpha)});
  const WidthRange range = lobe_width(materials, 0)->range();
  EXPECT_FLOAT_EQ(range.least, 0.1f);
  EXPECT_FLOAT_EQ(range.largest, 0.25f);
}

TEST(LobeWidth, IsFoundInsideWrappers) {
  const Texture alpha = board(0.4f, 0.05f);
  expect_range({metal(alpha, alpha), BumpMapMaterial{0, board(0, 1)}, TwoSidedMaterial{1, 1},
                MaskMaterial{2, Texture(0.5f)}},
               0.05f, 0.4f);
}

TEST(LobeWidth, IsNoneWhereThereIsNoneOrMoreThanOne) {
  const Texture alpha = board(0.4f, 0.05f);
  EXPECT_TRUE(has_width({metal(Texture(0.2f), Texture(0.2f))}));
  EXPECT_FALSE(has_width({metal(alpha, Texture(0.2f))}));
  EXPECT_FALSE(has_width({metal(alpha, board(0.3f, 0.05f))}));
  EXPECT_FALSE(has_width({DiffuseMaterial{}}));
  EXPECT_FALSE(
      has_width({metal(alpha, alpha), DiffuseMaterial{}, BlendMaterial{0, 1, Texture(0.5f)}}));
}

TEST(LobeWidth, IsHeldAwayFromZeroAndInfinity) {
  const std::vector<Material> materials =
      materials_of({metal(board(-1, 100), board(-1, 100)), metal(Texture(NAN), Texture(NAN))});
  EXPECT_FLOAT_EQ(lobe_width(materials, 0)->range().least, 1e-3f);
  EXPECT_FLOAT_EQ(lobe_width(materials, 0)->range().largest, 2);
}

TEST(LobeWidth, ABsdfResolvedAtAWidthIsThatOfAConstantMaterial) {
  const Texture alpha = board(0.4f, 0.05f);
  RoughPlasticMaterial plastic;
  plastic.alpha = alpha;
  PhongMaterial phong;
  phong.exponent = board(0, 198);
  const std::vector<Material> textured = materials_of(
      {metal(alpha, alpha), TwoSidedMaterial{0, 0}, plastic, TwoSidedMaterial{2, 2}, phong});
  plastic.alpha = Texture(0.1f), phong.exponent = Texture(198.0f);
  const std::vector<Material> constant = materials_of(
      {metal(Texture(0.1f), Texture(0.1f)), TwoSidedMaterial{0, 0}, plastic, plastic, phong});
  const Vec3 wo = Vec3(0.6f, 0, 0.8f), wi = Vec3(-0.5f, 0.1f, 0.86f).normalized();
  for (const int m : {1, 3, 4}) {
    const float expected = resolve_mean(constant, m).eval(wo, wi).y();
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(resolve_at_width(textured, m, 0.1f).eval(wo, wi).y(), expected, 1e-3f * expected);
  }
}

}  // namespace
}  // namespace waylight
