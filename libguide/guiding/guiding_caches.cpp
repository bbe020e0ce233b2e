#include "libguide/guiding/guiding_caches.h"

namespace waylight {

GuidingCaches::GuidingCaches(const BrdfCache* brdf, const GuideCacheView& guide,
                             size_t material_count)
    : brdf_(brdf), guide_(guide), fit_of_material_(material_count, -1) {
  if (!brdf_) return;
  for (size_t i = 0; i < brdf_->materials.size(); ++i)
    if (brdf_->materials[i].material < material_count)
      fit_of_material_[brdf_->materials[i].material] = static_cast<int>(i);
}

std::span<const GaussianComponent> GuidingCaches::brdf_lobes(int material, float cos_theta) const {
  if (material < 0 || fit_of_material_[material] < 0) return {};
  const MaterialFit& fit = brdf_->materials[fit_of_material_[material]];
  const float theta = std::acos(std::clamp(cos_theta, 0.0f, 1.0f));
  const uint32_t elevation = static_cast<uint32_t>(theta * (2 * kInvPi) * fit.entry_count);
  const BrdfCacheEntry& entry =
      brdf_->entries[fit.first_entry + std::min(elevation, fit.entry_count - 1)];
  return std::span(brdf_->components).subspan(entry.first_component, entry.component_count);
}

}  // namespace waylight
