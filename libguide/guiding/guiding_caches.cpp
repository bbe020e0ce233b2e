#include "libguide/guiding/guiding_caches.h"

#include "libguide/bsdf/lobe_traits.h"
#include "libguide/directional/entry_layout.h"

namespace waylight {
namespace {

struct EntrySeries {
  uint32_t first_entry;
  int entry_count;
};

// By the ratio of the widths; that of the middle where there is no width.
EntrySeries nearest_series(const MaterialFit& fit, float width) {
  EntrySeries nearest{fit.first_entry, static_cast<int>(fit.entry_count)};
  if (!(width > 0)) return nearest;
  float best = kInfinity;
  for (const WidthSeries& s : fit.widths) {
    const float ratio = std::max(s.width / width, width / s.width);
    if (!(ratio < best)) continue;
    best = ratio;
    nearest = {s.first_entry, static_cast<int>(s.entry_count)};
  }
  return nearest;
}

}  // namespace

GuidingCaches::GuidingCaches(const BrdfCache* brdf, const GuideCacheView& guide,
                             std::span<const Material> materials, std::span<const Medium> media)
    : brdf_(brdf),
      guide_(guide),
      media_(guide.medium, media),
      fit_of_material_(materials.size(), {-1, -1}) {
  if (!brdf_) return;
  std::vector<int> front(materials.size(), -1);
  for (size_t i = 0; i < brdf_->materials.size(); ++i)
    if (brdf_->materials[i].material < materials.size() && brdf_->materials[i].entry_count > 0)
      front[brdf_->materials[i].material] = static_cast<int>(i);
  for (const MaterialFit& fit : brdf_->materials)
    widths_.push_back(fit.widths.empty() || fit.material >= materials.size()
                          ? std::nullopt
                          : lobe_width(materials, static_cast<int>(fit.material)));
  for (size_t m = 0; m < materials.size(); ++m) {
    const int behind = material_behind(materials, static_cast<int>(m));
    fit_of_material_[m] = {front[m], behind >= 0 ? front[behind] : -1};
  }
}

FittedLobe GuidingCaches::brdf_lobe(int material, bool from_behind, const Vec3& wo,
                                    const Vec2& uv) const {
  if (material < 0 || !brdf_) return {};
  const int index = fit_of_material_[material][from_behind];
  if (index < 0) return {};
  const MaterialFit& fit = brdf_->materials[index];
  const EntrySeries series = nearest_series(fit, widths_[index] ? widths_[index]->at(uv) : 0);
  const int i = nearest_entry(fit.layout, wo, series.entry_count);
  const BrdfCacheEntry& entry = brdf_->entries[series.first_entry + i];
  return {std::span(brdf_->components).subspan(entry.first_component, entry.component_count),
          entry_rotation(fit.layout, wo, i, series.entry_count)};
}

}  // namespace waylight
