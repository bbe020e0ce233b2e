// The guided density of a path vertex is what its sampler makes, with fits of many materials and
// arbitrary light.

#include "libguide/guiding/direction_sampler.h"

#include "common/lent_fits.h"
#include "common/small_scenes.h"
#include "libguide/brdf_fit.h"
#include "statistical/density_assertions.h"

namespace waylight {
namespace {

using testing::DensityCheck;

// A floor z = 0 whose cache has one cell, tilted against it.
struct GuidedFloor {
  Scene scene;
  BrdfCache brdf;
  GuideCache guide;
  GuidingCaches caches;

  GuidedFloor(SceneDescription description, const Vec3& cell_normal,
              std::vector<GaussianComponent> light, int elevations = 64)
      : scene(std::move(description)) {
    BrdfFitOptions options;
    options.elevations = elevations;
    brdf = fit_brdfs(scene.description(), options, {}).cache;
    guide.scene_bounds = scene.bounds();
    guide.nodes.push_back({});
    add_cell(cell_normal, light, 1);
    prepare();
  }

  // A second cell for normals that point down.
  void add_cell_below(const Vec3& cell_normal, const std::vector<GaussianComponent>& light,
                      float irradiance) {
    guide.nodes = {{0, 1, kNormalAxis + 2}, {0, 1, kLeafAxis}, {0, 0, kLeafAxis}};
    add_cell(cell_normal, light, irradiance);
    prepare();
  }

  void prepare() {
    caches =
        GuidingCaches(testing::lend(brdf), GuideCacheView(guide), scene.description().materials);
    caches.load_fits();
  }

  void add_cell(const Vec3& normal, const std::vector<GaussianComponent>& light, float irradiance) {
    CacheCell cell;
    cell.normal = normal.normalized();
    cell.effective_samples = 1000;
    cell.irradiance = irradiance;
    cell.first_component = static_cast<uint32_t>(guide.components.size());
    cell.component_count = static_cast<uint32_t>(light.size());
    guide.cells.push_back(cell);
    guide.components.insert(guide.components.end(), light.begin(), light.end());
  }

  SurfacePoint floor_from(const Vec3& wo) const {
    const Ray ray{3 * wo, -wo};
    return scene.intersect(ray).value();
  }
};

SceneDescription floor_of(const MaterialModel& model) {
  SceneDescription scene;
  const int material = testing::add_two_sided(scene, "floor", model);
  testing::add_shape(scene, testing::rectangle({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}), material);
  return scene;
}

RoughConductorMaterial metal(float alpha_u, float alpha_v, MicrofacetDistribution kind) {
  RoughConductorMaterial m;
  m.alpha_u = Texture(alpha_u);
  m.alpha_v = Texture(alpha_v);
  m.distribution = kind;
  return m;
}

std::vector<std::pair<std::string, MaterialModel>> materials() {
  RoughPlasticMaterial plastic;
  plastic.alpha = Texture(0.1f);
  RoughConductorMaterial worn = metal(0.1f, 0.1f, MicrofacetDistribution::ggx);
  worn.alpha_u.source = CheckerboardTexture{Color::Constant(0.05f), Color::Constant(0.4f)};
  worn.alpha_v = worn.alpha_u;
  return {{"diffuse", DiffuseMaterial{}},
          {"ggx 0.3", metal(0.3f, 0.3f, MicrofacetDistribution::ggx)},
          {"ggx 0.05", metal(0.05f, 0.05f, MicrofacetDistribution::ggx)},
          {"beckmann 0.15", metal(0.15f, 0.15f, MicrofacetDistribution::beckmann)},
          {"brushed", metal(0.1f, 0.4f, MicrofacetDistribution::ggx)},
          {"roughplastic", plastic},
          {"plastic", PlasticMaterial{}},
          {"phong", PhongMaterial{}},
          {"ward", WardMaterial{}},
          {"worn", worn}};
}

// A wide lobe, a narrow one, an elongated one at the horizon of the cell.
std::vector<GaussianComponent> some_light() {
  return {{0.4f, 0.1f, -0.2f, 0.09f, 0.02f, 0.06f},
          {0.25f, -0.55f, 0.1f, 0.002f, 0, 0.003f},
          {0.35f, 0.3f, 0.85f, 0.04f, -0.01f, 0.01f}};
}

Vec3 from(float degrees, float azimuth) {
  const float theta = degrees * kPi / 180;
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

void expect_valid(const GuidedFloor& floor, DirectionGuide guide, float bsdf_share, const Vec3& wo,
                  const std::string& name) {
  const SurfacePoint at = floor.floor_from(wo);
  const DirectionSampler directions(floor.scene, floor.caches, {guide, bsdf_share}, at, wo);
  ASSERT_TRUE(directions.guided()) << name;
  DensityCheck check;
  check.tests = 120;
  check.samples = 40000;
  check.pilot = 4096;
  check.bins = 96;
  // Of the smooth part: delta samples are left to their own tests, and `pdf` counts their chance.
  expect_valid_density(
      testing::Sphere{}, name,
      [&](Sampler& sampler) -> std::optional<Vec3> {
        const std::optional<DirectionSample> s = directions.sample(sampler);
        if (!s || s->is_delta) return std::nullopt;
        return s->wi;
      },
      [&](const Vec3& wi) { return directions.pdf(wi); }, check);
}

TEST(DirectionSamplerSlow, GuidedDensitiesAreWhatTheSamplerMakes) {
  for (const auto& [name, model] : materials()) {
    const GuidedFloor floor(floor_of(model), {0.3f, -0.2f, 1}, some_light());
    for (const DirectionGuide guide :
         {DirectionGuide::illumination, DirectionGuide::product, DirectionGuide::mixture})
      for (const Vec3& wo : {from(5, 0), from(50, 2), from(80, -1)})
        expect_valid(floor, guide, 0.5f, wo,
                     fmt::format("{} guide {} z = {:.2f}", name, static_cast<int>(guide), wo.z()));
  }
}

TEST(DirectionSamplerSlow, DensitiesHoldAtTheEndsOfTheShareOfBsdfSampling) {
  const GuidedFloor floor(floor_of(metal(0.2f, 0.2f, MicrofacetDistribution::ggx)), {0, 0.1f, 1},
                          some_light());
  for (const float share : {0.01f, 0.99f})
    expect_valid(floor, DirectionGuide::product, share, from(40, 1),
                 fmt::format("share {}", share));
}

TEST(DirectionSamplerSlow, ABackWithAFitOfItsOwnIsSampledByIt) {
  SceneDescription scene;
  const int front = testing::add_material(scene, "front", DiffuseMaterial{});
  const int back =
      testing::add_material(scene, "back", metal(0.1f, 0.1f, MicrofacetDistribution::ggx));
  const int sheet = testing::add_material(scene, "sheet", TwoSidedMaterial{front, back});
  testing::add_shape(scene, testing::rectangle({-20, -20, 0}, {0, 40, 0}, {40, 0, 0}), sheet);
  const GuidedFloor floor(std::move(scene), {0.1f, 0, 1}, some_light());  // seen from behind
  expect_valid(floor, DirectionGuide::product, 0.5f, from(40, 1), "back");
  const auto lobes = [&](int material, bool from_behind) {
    return floor.caches.brdf_lobe(material, from_behind, from(60, 1), Vec2::Zero()).lobe;
  };
  EXPECT_NE(lobes(sheet, true), nullptr);
  EXPECT_EQ(lobes(sheet, true), lobes(back, false));
  EXPECT_NE(lobes(sheet, true), lobes(sheet, false));
}

// Its product is the light: nothing is multiplied for it, but for what gloss there is on it.
TEST(DirectionSampler, AUniformBsdfIsGuidedByTheLightAlone) {
  PlasticMaterial gloss;
  gloss.nonlinear = true;
  for (const auto& [name, model, uniform] :
       {std::tuple<std::string, MaterialModel, bool>{"diffuse", DiffuseMaterial{}, true},
        {"plastic", gloss, false}}) {
    const GuidedFloor floor(floor_of(model), {0.1f, 0, 1}, some_light());
    const Vec3 wo = from(40, 1);
    const SurfacePoint at = floor.floor_from(wo);
    const DirectionSampler product(floor.scene, floor.caches, {DirectionGuide::product}, at, wo);
    const DirectionSampler light(floor.scene, floor.caches, {DirectionGuide::illumination}, at, wo);
    const Vec3 wi = from(50, 2);
    EXPECT_EQ(product.pdf(wi) == light.pdf(wi), uniform) << name;
    EXPECT_EQ(product.reflected_estimate() == light.reflected_estimate(), uniform) << name;
  }
}

// Directions by guide: the mean of the weight is the albedo whatever guides.
double mean_weight(const GuidedFloor& floor, DirectionGuide guide, const Vec3& wo) {
  constexpr int kCount = 1 << 16;
  const DirectionSampler directions(floor.scene, floor.caches, {guide, 0.5f}, floor.floor_from(wo),
                                    wo);
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    Sampler sampler(9, 9, i);
    const std::optional<DirectionSample> s = directions.sample(sampler);
    if (s) sum += s->weight.y() / kCount;
  }
  return sum;
}

// A sheet of ground glass, seen from the side of its normal or, turned over, from inside the glass.
SceneDescription glass_floor(float alpha, bool turned) {
  RoughDielectricMaterial glass;
  glass.alpha_u = glass.alpha_v = Texture(alpha);
  SceneDescription scene;
  const int material = testing::add_material(scene, "glass", glass);
  const Vec3 x(40, 0, 0), y(0, 40, 0);
  testing::add_shape(scene, testing::rectangle({-20, -20, 0}, turned ? y : x, turned ? x : y),
                     material);
  return scene;
}

std::vector<GaussianComponent> light_from_below() {
  return {{0.7f, -0.4f, 0.2f, 0.02f, 0.005f, 0.03f}, {0.3f, 0.1f, 0.6f, 0.01f, 0, 0.02f}};
}

TEST(DirectionSamplerSlow, RoughGlassIsGuidedOverBothHemispheres) {
  for (const float alpha : {0.4f, 0.1f})
    for (const bool turned : {false, true}) {
      GuidedFloor floor(glass_floor(alpha, turned), {0.3f, -0.2f, 1}, some_light());
      floor.add_cell_below({0.1f, 0.2f, -1}, light_from_below(), 3);
      for (const DirectionGuide guide : {DirectionGuide::illumination, DirectionGuide::product})
        expect_valid(floor, guide, 0.4f, from(40, 1),
                     fmt::format("glass {} turned {}", alpha, turned));
      for (const DirectionGuide guide : {DirectionGuide::illumination, DirectionGuide::resampled})
        EXPECT_NEAR(mean_weight(floor, guide, from(40, 1)),
                    mean_weight(floor, DirectionGuide::none, from(40, 1)), 0.03);
    }
}

TEST(DirectionSamplerSlow, RoughGlassWithACellOnOneSideLeavesTheOtherToBsdfSampling) {
  GuidedFloor floor(glass_floor(0.3f, false), {0, 0, 1}, some_light());
  expect_valid(floor, DirectionGuide::illumination, 0.2f, from(40, 1), "one side");
  const Vec3 wo = from(40, 1);
  const DirectionSampler directions(floor.scene, floor.caches, {DirectionGuide::illumination, 0.2f},
                                    floor.floor_from(wo), wo);
  EXPECT_GT(directions.bsdf_share(), 0.9f);  // glass of index 1.5 reflects a twentieth
}

// The shading normal leaves both the surface's and the cell's.
TEST(DirectionSamplerSlow, NormalMapsAreGuidedInTheFrameOfTheShadingNormal) {
  for (const auto& [name, model] : materials()) {
    SceneDescription scene;
    const int nested = testing::add_material(scene, "nested", model);
    const Color tilted = 0.5f * (Color(0.35f, -0.2f, 0.9f) + 1);
    const int mapped =
        testing::add_material(scene, "mapped", NormalMapMaterial{nested, Texture(tilted)});
    const int floor_material =
        testing::add_material(scene, "floor", TwoSidedMaterial{mapped, mapped});
    testing::add_shape(scene, testing::rectangle({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}),
                       floor_material);
    const GuidedFloor floor(std::move(scene), {-0.2f, 0.1f, 1}, some_light());
    const Vec3 wo = from(40, 1);
    EXPECT_LT(floor.scene.bsdf(floor.floor_from(wo), wo, TransportMode::radiance).frame.n.z(),
              0.95f);
    expect_valid(floor, DirectionGuide::product, 0.3f, wo, name + " mapped");
    EXPECT_NEAR(mean_weight(floor, DirectionGuide::product, wo),
                mean_weight(floor, DirectionGuide::none, wo), 0.01)
        << name;
  }
}

TEST(DirectionSamplerSlow, TheReflectedShareDoesNotDependOnTheGuide) {
  for (const auto& [name, model] : materials()) {
    const GuidedFloor floor(floor_of(model), {0.3f, -0.2f, 1}, some_light());
    const double expected = mean_weight(floor, DirectionGuide::none, from(50, 2));
    for (const DirectionGuide guide : {DirectionGuide::illumination, DirectionGuide::product,
                                       DirectionGuide::mixture, DirectionGuide::resampled})
      EXPECT_NEAR(mean_weight(floor, guide, from(50, 2)), expected, 0.01) << name;
  }
}

// E[(f L / p)^2] / E[f L / p]^2 - 1 of samples of one vertex, L the light's own mixture.
double relative_variance(const GuidedFloor& floor, DirectionGuide guide, const Vec3& wo,
                         int candidates = 2, float share = 0.1f) {
  constexpr int kCount = 1 << 15;
  if (guide == DirectionGuide::resampled) share = 0.5f;
  const DirectionSampler directions(floor.scene, floor.caches, {guide, share, candidates},
                                    floor.floor_from(wo), wo);
  const GaussianMixture light(floor.guide.components);
  const Frame cell(floor.guide.cells[0].normal);
  double sum = 0, squares = 0;
  for (int i = 0; i < kCount; ++i) {
    Sampler sampler(9, 9, i);
    const std::optional<DirectionSample> s = directions.sample(sampler);
    if (!s) continue;
    // The mixture stands for L cos: the cosine is already in the weight.
    const double radiance =
        light.pdf(direction_to_disk(cell.to_local(s->wi))) / std::max(s->wi.z(), 0.05f);
    const double value = s->weight.y() * radiance;
    sum += value / kCount, squares += value * value / kCount;
  }
  return squares / (sum * sum) - 1;
}

TEST(DirectionSamplerSlow, TheProductOfFitAndLightLowersTheVarianceOfAVertex) {
  WardMaterial ward;
  ward.diffuse_reflectance = Texture(0.0f);
  ward.alpha_u = Texture(0.3f), ward.alpha_v = Texture(0.08f);
  RoughConductorMaterial worn = metal(0.1f, 0.1f, MicrofacetDistribution::ggx);
  worn.alpha_u.source = CheckerboardTexture{Color::Constant(0.1f), Color::Constant(0.4f)};
  worn.alpha_v = worn.alpha_u;
  const std::vector<std::pair<std::string, MaterialModel>> cases = {
      {"0.3", metal(0.3f, 0.3f, MicrofacetDistribution::beckmann)},
      {"0.1", metal(0.1f, 0.1f, MicrofacetDistribution::beckmann)},
      {"brushed", metal(0.08f, 0.3f, MicrofacetDistribution::ggx)},
      {"ward", ward},
      {"worn", worn}};
  for (const auto& [name, model] : cases) {
    const GuidedFloor floor(floor_of(model), {0.3f, -0.2f, 1}, some_light());
    for (const Vec3& wo : {from(20, 0.5f), from(50, 2)}) {
      const double none = relative_variance(floor, DirectionGuide::none, wo);
      const double light = relative_variance(floor, DirectionGuide::illumination, wo);
      const double product = relative_variance(floor, DirectionGuide::product, wo);
      EXPECT_LT(product, 0.5 * std::min(none, light))
          << name << " z " << wo.z() << ": " << none << " " << light;
    }
  }
}

// The narrower a lobe, the more constant light is over it, and the better BSDF sampling alone.
TEST(DirectionSamplerSlow, LobesTooNarrowForTheGuideAreLeftToBsdfSampling) {
  float last_share = 0.3f;
  for (const float alpha : {0.5f, 0.2f, 0.1f, 0.05f, 0.02f, 0.01f, 0.005f, 0.002f, 0.001f}) {
    const GuidedFloor floor(floor_of(metal(alpha, alpha, MicrofacetDistribution::ggx)),
                            {0.05f, 0, 1}, {{1, 0, 0, 0.25f, 0, 0.25f}}, 512);
    double bsdf = 0, product = 0;
    for (int i = 0; i < 6; ++i) {
      const Vec3 wo = from(10 * i + 5.1f, i);
      bsdf += 1 + relative_variance(floor, DirectionGuide::none, wo);
      product += 1 + relative_variance(floor, DirectionGuide::product, wo, 2, 0.3f);
    }
    EXPECT_LT(product, 1.02 * bsdf) << "alpha " << alpha;
    const Vec3 wo = from(30, 1);
    const DirectionSampler directions(floor.scene, floor.caches, {DirectionGuide::product, 0.3f},
                                      floor.floor_from(wo), wo);
    EXPECT_GT(directions.bsdf_share(), last_share - 1e-3f) << "alpha " << alpha;
    last_share = directions.bsdf_share();
  }
  EXPECT_GT(last_share, 0.95f);
}

TEST(DirectionSamplerSlow, ResamplingLowersTheVarianceOfAVertexTheMoreCandidatesItHas) {
  const GuidedFloor floor(floor_of(metal(0.3f, 0.3f, MicrofacetDistribution::ggx)),
                          {0.3f, -0.2f, 1}, some_light());
  for (const Vec3& wo : {from(20, 0.5f), from(50, 2)}) {
    double last = relative_variance(floor, DirectionGuide::resampled, wo, 1);
    for (const int candidates : {2, 4, 8}) {
      const double next = relative_variance(floor, DirectionGuide::resampled, wo, candidates);
      EXPECT_LT(next, 0.8 * last) << candidates << " candidates, z = " << wo.z();
      last = next;
    }
  }
}

}  // namespace
}  // namespace waylight
