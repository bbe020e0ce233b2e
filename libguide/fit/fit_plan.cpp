#include "libguide/fit/fit_plan.h"

#include <set>

#include "libguide/base/error.h"
#include "libguide/directional/entry_layout.h"
#include "libguide/fit/lobe_distance.h"

namespace waylight {
namespace {

void add_shown(const SceneDescription& scene, const Shape& shape, std::set<int>& shown) {
  if (shape.material == kNone) return;
  if (shape.material < 0 || shape.material >= static_cast<int>(scene.materials.size()))
    fail("shape \"{}\" refers to material {} of {}", shape.name, shape.material,
         scene.materials.size());
  shown.insert(shape.material);
  const int behind = material_behind(scene.materials, shape.material);
  if (behind >= 0) shown.insert(behind);
}

std::set<int> shown_materials(const SceneDescription& scene) {
  std::set<int> shown;
  for (const Shape& shape : scene.shapes) add_shown(scene, shape, shown);
  for (const Shape& shape : scene.group_shapes) add_shown(scene, shape, shown);
  return shown;
}

// Why a BSDF gets no fit, or null.
const char* reason_to_skip(const Bsdf& bsdf) {
  if (!bsdf.has_smooth()) return bsdf.count() ? "delta lobes only" : "nothing to scatter light";
  if (bsdf.smooth_transmissive()) return "rough transmission is sampled by the BSDF alone";
  if (is_black(bsdf.mean_reflectance())) return "black";
  return nullptr;
}

std::optional<WidthRange> textured_width(std::span<const Material> materials, int material) {
  const std::optional<LobeWidth> width = lobe_width(materials, material);
  if (!width) return std::nullopt;
  const WidthRange range = width->range();
  if (!(range.least < range.largest)) return std::nullopt;
  return range;
}

// Some wo all over the hemisphere.
constexpr int kProbes = 12;

// Whether the lobes of both have one shape, at their means; those of textured width have many.
bool alike(const PlannedFit& a, const PlannedFit& b, float tolerance) {
  if (a.traits.depends_on_wo != b.traits.depends_on_wo || a.layout != b.layout) return false;
  if (a.width_range || b.width_range) return false;
  const int probes = a.traits.depends_on_wo ? kProbes : 1;
  for (int i = 0; i < probes; ++i) {
    const Vec3 wo = entry_wo(EntryLayout::fibonacci, i, probes);
    if (lobe_distance({a.bsdf, wo}, {b.bsdf, wo}) > tolerance) return false;
  }
  return true;
}

int find_alike(const FitPlan& plan, const PlannedFit& fit, float tolerance) {
  for (size_t i = 0; i < plan.fits.size(); ++i)
    if (plan.fits[i].same_as < 0 && alike(plan.fits[i], fit, tolerance)) return static_cast<int>(i);
  return -1;
}

}  // namespace

FitPlan plan_fits(const SceneDescription& scene, float tolerance) {
  constexpr float kRounding = 1e-4f;  // of lobes that differ by a factor
  FitPlan plan;
  for (const int material : shown_materials(scene)) {
    PlannedFit fit{material, resolve_mean(scene.materials, material),
                   lobe_traits(scene.materials, material)};
    const Material& described = scene.materials[material];
    if (const char* reason = reason_to_skip(fit.bsdf)) {
      plan.skipped.push_back(
          fmt::format("{} ({}): {}", described.name, material_kind(described), reason));
      continue;
    }
    if (fit.traits.anisotropic) fit.layout = EntryLayout::fibonacci;
    fit.width_range = textured_width(scene.materials, material);
    fit.same_as = find_alike(plan, fit, std::max(tolerance, kRounding));
    plan.fits.push_back(std::move(fit));
  }
  return plan;
}

}  // namespace waylight
