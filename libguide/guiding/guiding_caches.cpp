#include "libguide/guiding/guiding_caches.h"

#include "libguide/bsdf/lobe_traits.h"

namespace waylight {

GuidingCaches::GuidingCaches(const BrdfCache* brdf, const GuideCacheView& guide,
                             std::span<const Material> materials)
    : brdf_(brdf), guide_(guide), fit_of_material_(materials.size(), {-1, -1}) {
  if (!brdf_) return;
  std::vector<int> front(materials.size(), -1);
  for (size_t i = 0; i < brdf_->materials.size(); ++i)
    if (brdf_->materials[i].material < materials.size() && brdf_->materials[i].entry_count > 0)
      front[brdf_->materials[i].material] = static_cast<int>(i);
  for (size_t m = 0; m < materials.size(); ++m) {
    const int behind = material_behind(materials, static_cast<int>(m));
    fit_of_material_[m] = {front[m], behind >= 0 ? front[behind] : -1};
  }
}

std::span<const GaussianComponent> GuidingCaches::brdf_lobes(int material, bool from_behind,
                                                             float cos_theta) const {
  if (material < 0 || !brdf_) return {};
  const int index = fit_of_material_[material][from_behind];
  if (index < 0) return {};
  const MaterialFit& fit = brdf_->materials[index];
  const float theta = std::acos(std::clamp(cos_theta, 0.0f, 1.0f));
  const uint32_t elevation = static_cast<uint32_t>(theta * (2 * kInvPi) * fit.entry_count);
  const BrdfCacheEntry& entry =
      brdf_->entries[fit.first_entry + std::min(elevation, fit.entry_count - 1)];
  return std::span(brdf_->components).subspan(entry.first_component, entry.component_count);
}

}  // namespace waylight
