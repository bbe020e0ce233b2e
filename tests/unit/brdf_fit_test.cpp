// Fitted mixtures are close to f, whatever the lobe; and the stage says what it left out and why.

#include "libguide/brdf_fit.h"

#include <gtest/gtest.h>

#include <cstring>

#include "common/small_scenes.h"
#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/base/sampler.h"
#include "libguide/bsdf/bsdf.h"
#include "libguide/directional/entry_layout.h"
#include "libguide/directional/gaussian_product.h"
#include "libguide/fit/lobe_error.h"
#include "libguide/fit/lobe_fit.h"

namespace waylight {
namespace {

constexpr MicrofacetDistribution kGgx = MicrofacetDistribution::ggx;
constexpr MicrofacetDistribution kBeckmann = MicrofacetDistribution::beckmann;

// A scene in which every material is shown by a sphere.
SceneDescription shown(const std::vector<MaterialModel>& models) {
  SceneDescription scene;
  for (const MaterialModel& model : models)
    testing::add_shape(
        scene, Sphere{},
        testing::add_material(scene, fmt::format("m{}", scene.materials.size()), model));
  return scene;
}

RoughConductorMaterial metal(float alpha, MicrofacetDistribution kind = kGgx) {
  RoughConductorMaterial m;
  m.eta = Color(1.66f, 0.88f, 0.52f);
  m.k = Color(9.2f, 6.3f, 4.8f);
  m.alpha_u = m.alpha_v = Texture(alpha);
  m.distribution = kind;
  return m;
}

BrdfFitResult fit(const SceneDescription& scene, int elevations, const RunControl& control = {}) {
  BrdfFitOptions options;
  options.elevations = elevations;
  options.tolerance = 0;
  return fit_brdfs(scene, options, control);
}

BrdfFitResult fit_within(const SceneDescription& scene, float tolerance) {
  BrdfFitOptions options;
  options.tolerance = tolerance;
  return fit_brdfs(scene, options, {});
}

BrdfCache fit(const MaterialModel& model, int elevations) {
  return fit(shown({model}), elevations).cache;
}

GaussianMixture mixture(const BrdfCache& cache, const BrdfCacheEntry& entry) {
  return GaussianMixture(
      std::span(cache.components).subspan(entry.first_component, entry.component_count));
}

Vec3 wo_of(size_t entry, size_t count) {
  const float theta = (entry + 0.5f) / count * 0.5f * kPi;
  return {std::sin(theta), 0, std::cos(theta)};
}

Vec2 mean_of(const GaussianMixture& mixture) {
  Vec2 mean = Vec2::Zero();
  for (int k = 0; k < mixture.count(); ++k) {
    const GaussianComponent c = mixture.component(k);
    mean += c.weight * Vec2(c.mean_x, c.mean_y);
  }
  return mean;
}

// The centroid of f on the disk, by a fine sum over the BSDF's own samples and the hemisphere.
Vec2 centroid_of(const Bsdf& bsdf, const Vec3& wo) {
  constexpr int kCount = 1 << 16;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0;
  for (int i = 0; i < kCount; ++i) {
    Sampler sampler(3, 4, i);
    const float u = sampler.next();
    const Vec2 u2 = sampler.next_2d();
    Vec3 wi = disk_to_direction(square_to_disk(u2));
    if (i % 2 == 0) {
      const std::optional<BsdfSample> s = bsdf.sample(wo, u, u2);
      if (!s) continue;
      wi = s->wi;
    }
    const EvalPdf e = bsdf.evaluate(wo, wi);
    if (!(wi.z() > 1e-5f)) continue;
    const double w = luminance(e.value) / wi.z() / (e.pdf + 0.5f * kInvPi);
    sum += w * direction_to_disk(wi).cast<double>();
    total += w;
  }
  return (sum / total).cast<float>();
}

// Components of a mixture of equal density over the disk for a photon density Li cos.
std::vector<GaussianComponent> cosine_mixture() {
  std::vector<WeightedPoint> points;
  for (int i = 0; i < 16384; ++i)
    points.push_back(
        {direction_to_disk(square_to_cosine_hemisphere(Sampler(5, 6, i).next_2d())), 1});
  return fit_mixture(points, {}).components;
}

// Mean |a - b| over the unit disk, both per unit area of it.
template <typename A, typename B>
double disk_distance(const A& a, const B& b) {
  constexpr int kCount = 1 << 14;
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    const Vec2 y = square_to_disk(Sampler(7, 8, i).next_2d());
    sum += std::abs(a(y) - b(y)) * kPi / kCount;
  }
  return sum;
}

TEST(BrdfFit, DiffuseTimesUniformRadianceIsTheCosineDensity) {
  const BrdfCache cache = fit(DiffuseMaterial{}, 16);
  ASSERT_EQ(cache.entries.size(), 1u);
  const GaussianMixture brdf = mixture(cache, cache.entries[0]);
  const GaussianMixture light(cosine_mixture());
  const GaussianProduct product(brdf, light);
  ASSERT_TRUE(product.valid());
  const auto cosine = [](const Vec2& y) {
    return cosine_hemisphere_pdf(disk_to_direction(y)) * kSteradianPerDiskArea;
  };
  const auto of_product = [&](const Vec2& y) { return product.pdf(y); };
  const auto squared = [&](const Vec2& y) { return 1.5f * kInvPi * 2 * sqr(1 - y.squaredNorm()); };
  // Counted twice, the cosine would give its square.
  EXPECT_LT(disk_distance(of_product, cosine), 0.25);
  EXPECT_LT(disk_distance(of_product, cosine), 0.6 * disk_distance(of_product, squared));
}

TEST(BrdfFit, DiffuseIsFlatAwayFromTheRim) {
  const BrdfCache cache = fit(DiffuseMaterial{}, 16);
  const GaussianMixture brdf = mixture(cache, cache.entries[0]);
  EXPECT_LT(cache.entries[0].held_out_error, 0.26f);
  double sum = 0;
  constexpr int kCount = 4096;
  for (int i = 0; i < kCount; ++i)
    sum += brdf.pdf(0.7f * square_to_disk(Sampler(1, 1, i).next_2d())) / kCount;
  EXPECT_NEAR(sum, kInvPi, 0.1 * kInvPi);
}

TEST(BrdfFit, RoughConductorsAreFittedToAStatedError) {
  // The mean over elevations, and the worst elevation up to 75 degrees.
  const struct {
    float alpha, mean, worst;
  } cases[] = {{0.3f, 0.13f, 0.16f}, {0.15f, 0.10f, 0.13f}, {0.05f, 0.07f, 0.13f}};
  for (const auto& c : cases) {
    const BrdfFitResult result = fit(shown({metal(c.alpha)}), 18);
    EXPECT_LT(result.summary.materials[0].held_out_error, c.mean) << "alpha " << c.alpha;
    for (int i = 0; i < 15; ++i)
      EXPECT_LT(result.cache.entries[i].held_out_error, c.worst)
          << "alpha " << c.alpha << " elevation " << i;
  }
}

// EM keeps the moments of its points. The refinement may not, but no more mass than its error is in
// the wrong place.
void expect_centroids(FitMethod method) {
  for (const float alpha : {0.3f, 0.15f, 0.05f}) {
    const SceneDescription scene = shown({metal(alpha)});
    BrdfFitOptions options;
    options.elevations = 9, options.method = method;
    const BrdfCache cache = fit_brdfs(scene, options, {}).cache;
    const Bsdf bsdf = resolve_mean(scene.materials, 0);
    for (size_t i = 0; i < cache.entries.size(); ++i) {
      const Vec2 mean = mean_of(mixture(cache, cache.entries[i]));
      const Vec2 expected = centroid_of(bsdf, wo_of(i, cache.entries.size()));
      const float error = method == FitMethod::em ? 0.1f * alpha : cache.entries[i].held_out_error;
      EXPECT_LT((mean - expected).norm(), 0.02f + error) << alpha << " entry " << i;
    }
  }
}

TEST(BrdfFit, TheMeanOfTheMixtureIsTheCentroidOfF) { expect_centroids(FitMethod::em); }
TEST(BrdfFit, TheMeanOfARefinedMixtureIsTheCentroidWithinItsError) {
  expect_centroids(FitMethod::best);
}

TEST(BrdfFit, ANarrowLobeLiesAtTheMirrorDirection) {
  const BrdfCache cache = fit(metal(0.01f, kBeckmann), 9);
  for (size_t i = 0; i + 1 < cache.entries.size(); ++i) {
    const Vec3 wo = wo_of(i, cache.entries.size());
    const Vec2 mirror = direction_to_disk({-wo.x(), 0, wo.z()});
    EXPECT_LT((mean_of(mixture(cache, cache.entries[i])) - mirror).norm(), 0.01f) << i;
  }
}

// |f - G| summed on a polar grid about the mirror direction, for an isotropic narrow lobe.
double error_by_quadrature(const Bsdf& bsdf, const Vec3& wo, const GaussianMixture& g) {
  constexpr int kCount = 400;
  const Vec2 mirror = direction_to_disk({-wo.x(), -wo.y(), wo.z()});
  double total = 0, difference = 0;
  std::vector<std::pair<double, double>> values;
  std::vector<double> areas;
  for (int i = 0; i < kCount; ++i) {
    const double inner = 2 * std::pow(double(i) / kCount, 5);
    const double outer = 2 * std::pow(double(i + 1) / kCount, 5), r = 0.5 * (inner + outer);
    for (int j = 0; j < 64; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / 64;
      const Vec2 y = mirror + Eigen::Vector2d(r * std::cos(phi), r * std::sin(phi)).cast<float>();
      if (y.squaredNorm() >= 1) continue;
      const Vec3 wi = disk_to_direction(y);
      values.push_back({luminance(bsdf.eval(wo, wi)) / wi.z(), g.pdf(y)});
      areas.push_back(std::numbers::pi * (outer * outer - inner * inner) / 64);
    }
  }
  for (size_t i = 0; i < values.size(); ++i) total += values[i].first * areas[i];
  for (size_t i = 0; i < values.size(); ++i)
    difference += std::abs(values[i].first / total - values[i].second) * areas[i];
  return difference;
}

TEST(BrdfFit, TheHeldOutErrorIsThatOfQuadratureAtAnyWidth) {
  for (const float alpha : {0.001f, 0.01f, 0.1f, 0.5f}) {
    const SceneDescription scene = shown({metal(alpha)});
    const BrdfCache cache = fit(scene, 5).cache;
    const Bsdf bsdf = resolve_mean(scene.materials, 0);
    for (int i = 0; i < 4; ++i) {
      const GaussianMixture g = mixture(cache, cache.entries[i]);
      EXPECT_NEAR(cache.entries[i].held_out_error, error_by_quadrature(bsdf, wo_of(i, 5), g), 0.03)
          << "alpha " << alpha << " entry " << i;
    }
  }
}

std::vector<MaterialModel> all_kinds() {
  std::vector<MaterialModel> models;
  for (const MicrofacetDistribution kind : {kGgx, kBeckmann}) {
    for (const float alpha : {0.001f, 0.01f, 0.1f, 1.0f}) models.push_back(metal(alpha, kind));
    RoughPlasticMaterial plastic;
    plastic.distribution = kind;
    for (const float alpha : {0.01f, 0.3f}) {
      plastic.alpha = Texture(alpha);
      models.push_back(plastic);
    }
    RoughConductorMaterial brushed = metal(0.01f, kind);
    brushed.alpha_v = Texture(1.0f);
    models.push_back(brushed);
  }
  for (const float exponent : {0.0f, 30.0f, 1e6f}) {
    PhongMaterial phong;
    phong.exponent = Texture(exponent);
    models.push_back(phong);
  }
  for (const auto variant : {WardMaterial::Variant::ward, WardMaterial::Variant::ward_duer,
                             WardMaterial::Variant::balanced}) {
    WardMaterial ward;
    ward.variant = variant;
    models.push_back(ward);
  }
  models.push_back(PlasticMaterial{});
  return models;
}

void expect_finite_fit(const LobeTarget& target, const std::string& name) {
  const std::vector<GaussianComponent> components = LobeFitter({}).fit(target).components;
  const GaussianMixture mixture(components);
  ASSERT_GT(mixture.count(), 0) << name;
  ASSERT_EQ(mixture.count(), static_cast<int>(components.size())) << name;
  for (const GaussianComponent& c : components)
    for (const float v : {c.weight, c.mean_x, c.mean_y, c.cov_xx, c.cov_xy, c.cov_yy})
      ASSERT_TRUE(std::isfinite(v)) << name;
  const float error = held_out_error(target, mixture, 0);
  ASSERT_GE(error, 0) << name;
  ASSERT_LE(error, 2) << name;
}

TEST(BrdfFit, EveryLobeGivesAFiniteMixtureUpToGrazingElevations) {
  const SceneDescription scene = shown(all_kinds());
  for (size_t m = 0; m < scene.materials.size(); ++m) {
    const Bsdf bsdf = resolve_mean(scene.materials, static_cast<int>(m));
    for (const float degrees : {0.1f, 30.0f, 60.0f, 80.0f, 89.0f, 89.9f, 89.99f}) {
      const float theta = degrees * kPi / 180;
      const Vec3 wo(std::sin(theta) * 0.8f, std::sin(theta) * 0.6f, std::cos(theta));
      expect_finite_fit(
          LobeTarget(bsdf, wo),
          fmt::format("{} {} from {}", material_kind(scene.materials[m]), m, degrees));
    }
  }
}

TEST(BrdfFit, TexturedMaterialsAreFittedAtTheirMeanAndSaySo) {
  DiffuseMaterial checked;
  checked.reflectance.source =
      CheckerboardTexture{Color(0.1f, 0.1f, 0.1f), Color(0.9f, 0.5f, 0.2f)};
  std::vector<std::string> warnings;
  RunControl control;
  control.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  const BrdfFitResult result = fit(shown({checked, DiffuseMaterial{}}), 4, control);
  EXPECT_TRUE(result.cache.materials[0].textured);
  EXPECT_FALSE(result.cache.materials[1].textured);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "material \"m0\" is textured: fitted at mean parameters");
}

TEST(BrdfFit, AnisotropicLobesAreFittedAsWellAsIsotropicOnes) {
  RoughConductorMaterial brushed = metal(0.05f);
  brushed.alpha_v = Texture(0.4f);
  WardMaterial ward;
  ward.diffuse_reflectance = Texture(0.0f);
  ward.alpha_u = Texture(0.05f), ward.alpha_v = Texture(0.3f);
  BrdfFitOptions options;
  options.elevations = options.directions = 128;
  options.tolerance = 0;
  const BrdfFitResult result =
      fit_brdfs(shown({brushed, metal(0.05f), metal(0.4f), ward}), options, {});
  EXPECT_EQ(result.cache.materials[0].layout, EntryLayout::fibonacci);
  EXPECT_EQ(result.cache.materials[1].layout, EntryLayout::elevations);
  const std::vector<MaterialFitSummary>& fits = result.summary.materials;
  const double isotropic = std::max(fits[1].held_out_error, fits[2].held_out_error);
  EXPECT_LT(fits[0].held_out_error, 1.2 * isotropic);  // averaged over azimuths it would be 1.25
  EXPECT_LT(fits[3].held_out_error, 1.2 * isotropic);
}

TEST(BrdfFit, ASmallerToleranceGivesMoreEntriesUpToTheMost) {
  RoughConductorMaterial brushed = metal(0.1f);
  brushed.alpha_v = Texture(0.3f);
  const SceneDescription scene = shown({metal(0.1f), brushed, RoughPlasticMaterial{}});
  std::vector<int> last(3, 0);
  for (const float tolerance : {0.5f, 0.1f, 0.03f}) {
    const BrdfFitResult result = fit_within(scene, tolerance);
    for (int i = 0; i < 3; ++i) {
      const int entries = result.summary.materials[i].entries;
      EXPECT_GE(entries, last[i]) << "tolerance " << tolerance << " material " << i;
      EXPECT_LE(entries, i == 1 ? 4096 : 512);
      last[i] = entries;
    }
  }
  EXPECT_GT(last[1], 16);
}

TEST(BrdfFit, WithinTheToleranceFewEntriesFollowTheLobeAtAnyElevation) {
  for (const float alpha : {0.3f, 0.05f, 0.01f}) {
    const SceneDescription scene = shown({metal(alpha)});
    const BrdfFitResult result = fit_within(scene, 0.03f);
    const int n = result.summary.materials[0].entries;
    EXPECT_LE(n, 64) << "alpha " << alpha;
    const Bsdf bsdf = resolve_mean(scene.materials, 0);
    double sum = 0;
    constexpr int kPlaces = 40;
    for (int i = 0; i < kPlaces; ++i) {
      const Vec3 wo = wo_of(i, kPlaces);
      const int entry = nearest_entry(EntryLayout::elevations, wo, n);
      const Mat3 rotation = entry_rotation(EntryLayout::elevations, wo, entry, n);
      const GaussianMixture g = mixture(result.cache, result.cache.entries[entry]);
      sum += held_out_error(LobeTarget(bsdf, wo), g.carried(rotation), 3) / kPlaces;
    }
    EXPECT_LT(sum, result.summary.materials[0].held_out_error + 0.04) << "alpha " << alpha;
  }
}

Texture board(float a, float b) {
  Texture texture;
  texture.source = CheckerboardTexture{Color::Constant(a), Color::Constant(b)};
  return texture;
}

RoughConductorMaterial worn_metal(float least, float largest) {
  RoughConductorMaterial m = metal(0.1f);
  m.alpha_u = m.alpha_v = board(least, largest);
  return m;
}

TEST(BrdfFit, ATexturedWidthGetsASeriesOfWidths) {
  const BrdfFitResult result = fit_within(shown({worn_metal(0.05f, 0.4f)}), 0.05f);
  const MaterialFit& fit = result.cache.materials[0];
  ASSERT_GT(fit.widths.size(), 2u);
  EXPECT_GE(fit.widths.front().width, 0.05f);
  EXPECT_LE(fit.widths.back().width, 0.4f);
  for (size_t i = 1; i < fit.widths.size(); ++i)
    EXPECT_GT(fit.widths[i].width, fit.widths[i - 1].width);
  EXPECT_EQ(fit.first_entry, fit.widths[fit.widths.size() / 2].first_entry);
  EXPECT_LT(result.summary.materials[0].held_out_error, 0.25);
}

TEST(BrdfFit, AFamilyServesItsLobesOfAnyWidthAndNoOthers) {
  BrdfFitOptions options;
  options.tolerance = 0.1f;
  const BrdfCache family = fit_family("roughconductor-ggx", options, {}).cache;
  RoughPlasticMaterial plastic;
  plastic.alpha = Texture(0.1f);
  const BrdfFitResult result = fit_brdfs(shown({worn_metal(0.05f, 0.4f), metal(0.1f), plastic}),
                                         options, {}, std::span(&family, 1));
  EXPECT_TRUE(result.summary.materials[0].from_family);
  EXPECT_GT(result.summary.materials[0].widths, 2);
  EXPECT_LT(result.summary.materials[0].widths,
            static_cast<int>(family.materials[0].widths.size()));
  EXPECT_TRUE(result.summary.materials[1].from_family);
  EXPECT_TRUE(result.cache.materials[1].widths.empty());
  EXPECT_FALSE(result.summary.materials[2].from_family);
}

TEST(BrdfFit, AnUnknownFamilyIsRefusedWithThoseThereAre) {
  try {
    fit_family("velvet", {}, {});
    FAIL();
  } catch (const Misuse& e) {
    EXPECT_STREQ(e.what(),
                 "--family velvet: is none of roughconductor-ggx, roughconductor-beckmann, phong, "
                 "ward");
  }
}

TEST(BrdfFit, MaterialsThatDifferInColourOnlyShareTheirEntries) {
  RoughConductorMaterial tinted = metal(0.2f);
  tinted.specular_reflectance = Texture(Color(0.9f, 0.4f, 0.1f));
  PhongMaterial phong, other_ratio, darker;
  darker.diffuse_reflectance = Texture(0.25f), darker.specular_reflectance = Texture(0.1f);
  other_ratio.diffuse_reflectance = Texture(0.1f);
  const BrdfFitResult result =
      fit(shown({DiffuseMaterial{Texture(0.5f)}, DiffuseMaterial{Texture(Color(0.9f, 0.1f, 0.2f))},
                 metal(0.2f), tinted, phong, other_ratio, darker}),
          4);
  const std::vector<MaterialFitSummary>& fits = result.summary.materials;
  EXPECT_EQ(fits[1].shares_with, "m0");
  EXPECT_EQ(fits[5].shares_with, "");
  EXPECT_EQ(fits[6].shares_with, "m4");
  EXPECT_EQ(result.cache.materials[6].first_entry, result.cache.materials[4].first_entry);
  EXPECT_EQ(result.summary.cost.entries, result.cache.entries.size());
  EXPECT_EQ(result.summary.full.entries, 2u + 5 * 4);
}

TEST(BrdfFit, MaterialsWithoutAFitAreListedWithTheReason) {
  const BrdfFitResult result =
      fit(shown({ConductorMaterial{}, DielectricMaterial{}, NullMaterial{},
                 RoughDielectricMaterial{}, DiffuseMaterial{Texture(0.0f)}}),
          4);
  EXPECT_TRUE(result.cache.materials.empty());
  EXPECT_EQ(result.summary.skipped,
            (std::vector<std::string>{
                "m0 (conductor): delta lobes only", "m1 (dielectric): delta lobes only",
                "m2 (null): nothing to scatter light",
                "m3 (roughdielectric): rough transmission is sampled by the BSDF alone",
                "m4 (diffuse): black"}));
}

TEST(BrdfFit, OnlyMaterialsThatShapesShowAreFitted) {
  SceneDescription scene;
  testing::add_material(scene, "unused", DiffuseMaterial{});
  testing::add_shape(scene, Sphere{}, testing::add_two_sided(scene, "wall", metal(0.2f)));
  const BrdfCache cache = fit(scene, 4).cache;
  ASSERT_EQ(cache.materials.size(), 1u);
  EXPECT_EQ(cache.materials[0].name, "wall");
  EXPECT_EQ(cache.materials[0].material, 2u);
  EXPECT_EQ(cache.materials[0].kind, "roughconductor");
}

TEST(BrdfFit, ABackThatDiffersHasAFitOfItsOwn) {
  SceneDescription scene;
  const int front = testing::add_material(scene, "front", DiffuseMaterial{});
  const int back = testing::add_material(scene, "back", metal(0.2f));
  const int wall = testing::add_material(scene, "wall", TwoSidedMaterial{front, back});
  testing::add_shape(scene, Sphere{}, wall);
  const BrdfCache cache = fit(scene, 4).cache;
  ASSERT_EQ(cache.materials.size(), 2u);
  EXPECT_EQ(cache.materials[0].name, "back");
  EXPECT_EQ(cache.materials[0].entry_count, 4u);
  EXPECT_EQ(cache.materials[1].name, "wall");
  EXPECT_EQ(cache.materials[1].entry_count, 1u);
}

TEST(BrdfFit, EqualMaterialsShareTheirEntries) {
  const BrdfFitResult result = fit(shown({metal(0.2f), metal(0.3f), metal(0.2f)}), 4);
  const std::vector<MaterialFit>& fits = result.cache.materials;
  ASSERT_EQ(fits.size(), 3u);
  EXPECT_EQ(result.cache.entries.size(), 8u);
  EXPECT_EQ(fits[0].first_entry, fits[2].first_entry);
  EXPECT_NE(fits[0].first_entry, fits[1].first_entry);
  EXPECT_EQ(result.summary.materials[2].shares_with, "m0");
  EXPECT_EQ(result.summary.materials[2].bytes, 0u);
}

TEST(BrdfFit, TheResultIsTheSameAtAnyThreadCount) {
  const SceneDescription scene = shown({metal(0.1f), PhongMaterial{}, DiffuseMaterial{}});
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return fit(scene, 16).cache;
  };
  const BrdfCache one = with_threads(1), two = with_threads(2);
  ASSERT_EQ(one.components.size(), two.components.size());
  EXPECT_EQ(std::memcmp(one.components.data(), two.components.data(),
                        one.components.size() * sizeof(GaussianComponent)),
            0);
  EXPECT_EQ(std::memcmp(one.entries.data(), two.entries.data(),
                        one.entries.size() * sizeof(BrdfCacheEntry)),
            0);
}

TEST(BrdfFit, AStoppedRunGivesNothing) {
  std::atomic<bool> stop{false};
  RunControl control;
  control.stop = &stop;
  control.on_progress = [&](double, double, const char*) { stop = true; };
  const BrdfFitResult result = fit(shown({metal(0.1f), metal(0.2f), metal(0.1f)}), 200, control);
  EXPECT_TRUE(result.cache.materials.empty());
  EXPECT_TRUE(result.summary.materials.empty());
}

TEST(BrdfFitOptionsTest, ValidateNamesTheField) {
  const auto message = [](const auto& change) -> std::string {
    BrdfFitOptions options;
    change(options);
    try {
      options.validate();
    } catch (const Misuse& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message([](BrdfFitOptions&) {}), "");
  EXPECT_NE(message([](auto& o) { o.elevations = 0; }).find("--elevations 0"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.directions = 0; }).find("--directions 0"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.tolerance = NAN; }).find("--tolerance nan"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.components = 17; }).find("--components 17"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.samples = 15; }).find("--samples 15"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.prior.a = 2; }).find("prior.a is 2"), std::string::npos);
  EXPECT_NE(message([](auto& o) { o.prior.b = NAN; }).find("prior.b is nan"), std::string::npos);
}

}  // namespace
}  // namespace waylight
