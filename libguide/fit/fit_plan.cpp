#include "libguide/fit/fit_plan.h"

#include <bit>
#include <set>
#include <unordered_map>

#include "libguide/base/error.h"
#include "libguide/base/sampler.h"
#include "libguide/fit/lobe_target.h"

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

// Of the directions and values that its sampler makes from several wo: equal for equal BSDFs, and
// for others not but by a collision of 64 bits.
uint64_t fingerprint(const Bsdf& bsdf, const LobeTraits& traits) {
  constexpr int kElevations = 8, kProbes = 16;
  uint64_t hash = traits.depends_on_wo * 2 + traits.anisotropic;
  const auto add = [&](float v) { hash = hash_combine(hash, std::bit_cast<uint32_t>(v)); };
  for (int e = 0; e < kElevations; ++e) {
    const LobeTarget target(bsdf, entry_theta(e, kElevations), static_cast<float>(e));
    for (int i = 0; i < kProbes; ++i) {
      Sampler sampler(0, e, i);
      const float u = sampler.next();
      const Vec3 wi = target.sample(u, sampler.next_2d()).value_or(Vec3(0, 0, 1));
      const LobeTarget::Value at = target.evaluate(wi);
      for (const float v : {wi.x(), wi.y(), wi.z(), at.f, at.pdf}) add(v);
    }
  }
  return hash;
}

}  // namespace

FitPlan plan_fits(const SceneDescription& scene, int elevations) {
  FitPlan plan;
  std::unordered_map<uint64_t, int> seen;
  for (const int material : shown_materials(scene)) {
    PlannedFit fit{material, resolve_mean(scene.materials, material),
                   lobe_traits(scene.materials, material)};
    const Material& described = scene.materials[material];
    if (const char* reason = reason_to_skip(fit.bsdf)) {
      plan.skipped.push_back(
          fmt::format("{} ({}): {}", described.name, material_kind(described), reason));
      continue;
    }
    fit.entries = fit.traits.depends_on_wo ? elevations : 1;
    const int index = static_cast<int>(plan.fits.size());
    const int first = seen.try_emplace(fingerprint(fit.bsdf, fit.traits), index).first->second;
    fit.same_as = first == index ? -1 : first;
    plan.fits.push_back(std::move(fit));
  }
  return plan;
}

}  // namespace waylight
