#include "libguide/fit/lobe_family.h"

#include <fmt/ranges.h>

#include "libguide/base/error.h"
#include "libguide/directional/entry_layout.h"
#include "libguide/fit/lobe_error.h"

namespace waylight {
namespace {

constexpr float kLeast = 0.005f, kLargest = 1;

Texture board(float a, float b) {
  Texture texture;
  texture.source = CheckerboardTexture{Color::Constant(a), Color::Constant(b)};
  return texture;
}

MaterialModel rough_conductor(MicrofacetDistribution distribution) {
  RoughConductorMaterial m;
  m.eta = Color::Zero(), m.k = Color::Constant(1e6f);  // a perfect mirror's facets
  m.alpha_u = m.alpha_v = board(kLeast, kLargest);
  m.distribution = distribution;
  return m;
}

MaterialModel phong() {
  const auto exponent = [](float width) { return 2 / sqr(width) - 2; };
  return PhongMaterial{Texture(0.0f), Texture(1.0f), board(exponent(kLeast), exponent(kLargest))};
}

MaterialModel ward() {
  WardMaterial m;
  m.diffuse_reflectance = Texture(0.0f), m.specular_reflectance = Texture(1.0f);
  m.alpha_u = m.alpha_v = board(kLeast, kLargest);
  return m;
}

struct Family {
  const char* name;
  MaterialModel (*model)();
};

constexpr Family kFamilies[] = {
    {"roughconductor-ggx", [] { return rough_conductor(MicrofacetDistribution::ggx); }},
    {"roughconductor-beckmann", [] { return rough_conductor(MicrofacetDistribution::beckmann); }},
    {"phong", phong},
    {"ward", ward}};

size_t nearest_width(std::span<const WidthSeries> widths, float width) {
  const auto distance = [&](const WidthSeries& s) { return std::abs(std::log(s.width / width)); };
  const auto nearest = std::min_element(
      widths.begin(), widths.end(),
      [&](const WidthSeries& a, const WidthSeries& b) { return distance(a) < distance(b); });
  return nearest - widths.begin();
}

EntryFit entry_of(const BrdfCache& cache, uint32_t index) {
  const BrdfCacheEntry& entry = cache.entries[index];
  const std::span<const GaussianComponent> components =
      std::span(cache.components).subspan(entry.first_component, entry.component_count);
  return {{components.begin(), components.end()}, entry.held_out_error, {}};
}

// Above the entry's own error, for the lobe seen from wo.
float excess(const BrdfCache& cache, const WidthSeries& series, const Bsdf& bsdf, const Vec3& wo,
             uint64_t seed) {
  const int n = static_cast<int>(series.entry_count);
  const int i = nearest_entry(EntryLayout::elevations, wo, n);
  const EntryFit entry = entry_of(cache, series.first_entry + i);
  const GaussianMixture mixture(entry.components);
  const Mat3 rotation = entry_rotation(EntryLayout::elevations, wo, i, n);
  return held_out_error(LobeTarget(bsdf, wo), mixture.carried(rotation), seed) -
         entry.held_out_error;
}

// The family itself is as exact as the tolerance between its wo, and again between its widths.
bool serves(const BrdfCache& cache, const WidthSeries& series, const Bsdf& bsdf, float tolerance,
            uint64_t seed) {
  constexpr int kElevations = 9;
  float sum = 0;
  for (int i = 0; i < kElevations; ++i)
    sum += excess(cache, series, bsdf, entry_wo(EntryLayout::elevations, i, kElevations), seed);
  return sum / kElevations <= 2 * tolerance;
}

// Least, middle and largest of a material's widths; none where it has no width.
std::vector<float> widths_of(std::span<const Material> materials, const PlannedFit& fit) {
  const std::optional<LobeWidth> width = lobe_width(materials, fit.material);
  if (!width) return {};
  if (!fit.width_range) return {width->mean()};
  const auto [least, largest] = *fit.width_range;
  return {least, std::sqrt(least * largest), largest};
}

std::vector<FittedSeries> series_of(const BrdfCache& family, std::span<const WidthSeries> widths,
                                    bool textured) {
  std::vector<FittedSeries> series;
  for (const WidthSeries& s : widths) {
    series.push_back({textured ? s.width : 0, {}, 0, 0});
    for (uint32_t i = 0; i < s.entry_count; ++i)
      series.back().entries.push_back(entry_of(family, s.first_entry + i));
  }
  return series;
}

}  // namespace

std::vector<std::string> family_names() {
  std::vector<std::string> names;
  for (const Family& family : kFamilies) names.push_back(family.name);
  return names;
}

SceneDescription family_scene(const std::string& name) {
  for (const Family& family : kFamilies) {
    if (name != family.name) continue;
    SceneDescription scene;
    scene.materials.push_back({name, family.model()});
    Shape shape;
    shape.geometry = Sphere{};
    shape.material = 0;
    scene.shapes.push_back(std::move(shape));
    return scene;
  }
  throw Misuse(fmt::format("--family {}: is none of {}", name, fmt::join(family_names(), ", ")));
}

std::vector<FittedSeries> family_series(const BrdfCache& family,
                                        std::span<const Material> materials, const PlannedFit& fit,
                                        float tolerance, uint64_t seed) {
  const std::vector<float> needed = widths_of(materials, fit);
  if (needed.empty()) return {};
  for (const MaterialFit& member : family.materials) {
    if (member.widths.empty() || member.layout != EntryLayout::elevations) continue;
    const std::span<const WidthSeries> widths = member.widths;
    const bool all = std::all_of(needed.begin(), needed.end(), [&](float width) {
      const Bsdf bsdf = resolve_at_width(materials, fit.material, width);
      return serves(family, widths[nearest_width(widths, width)], bsdf, tolerance, seed);
    });
    const size_t first = nearest_width(widths, needed.front());
    const size_t last = nearest_width(widths, needed.back());
    if (all)
      return series_of(family, widths.subspan(first, last - first + 1),
                       fit.width_range.has_value());
  }
  return {};
}

}  // namespace waylight
