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

constexpr float kMinMeanCosine = 0.05f;

// Mean of cos = 1 - |y|^2 over lobes on the disk.
float cosine_over(const GaussianMixture& lobes) {
  float cosine = 1;
  for (int k = 0; k < lobes.count(); ++k) {
    const GaussianComponent g = lobes.component(k);
    cosine -= g.weight * (sqr(g.mean_x) + sqr(g.mean_y) + g.cov_xx + g.cov_yy);
  }
  return std::max(cosine, kMinMeanCosine);
}

}  // namespace

BrdfLobe::BrdfLobe(std::span<const GaussianComponent> components, const Vec3& of)
    : mixture(components), wo(of), mean_cosine(cosine_over(mixture)) {}

GuidingCaches::GuidingCaches(BrdfSource fits, const GuideCacheView& guide,
                             std::span<const Material> materials, std::span<const Medium> media)
    : fits_(std::move(fits)),
      materials_(materials),
      guide_(guide),
      finder_(guide.nodes),
      media_(guide.medium, media),
      fit_of_material_(materials.size(), {-1, -1}),
      uniform_(materials.size(), {false, false}) {
  for (const CacheCell& cell : guide.cells)
    mixtures_.push_back(reinterpret_cast<uintptr_t>(guide.components.data()) +
                        cell.first_component * sizeof(GaussianComponent));
  for (size_t m = 0; m < materials.size(); ++m) {
    const int behind = material_behind(materials, static_cast<int>(m));
    smooth_.push_back(lobe_traits(materials, static_cast<int>(m)).smooth || behind < 0 ||
                      lobe_traits(materials, behind).smooth);
  }
}

void GuidingCaches::load_fits() {
  if (brdf_ || !fits_) return;
  brdf_ = fits_();
  prepare_lobes();
  prepare_materials();
}

void GuidingCaches::drop_fits() {
  fits_ = nullptr;
  brdf_.reset();
  lobes_ = {};
}

void GuidingCaches::prepare_lobes() {
  for (const BrdfCacheEntry& entry : brdf_->entries)
    lobes_.emplace_back(
        std::span(brdf_->components).subspan(entry.first_component, entry.component_count),
        Vec3::UnitZ());
  const auto stand_for = [&](EntryLayout layout, uint32_t first, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
      lobes_[first + i].wo = entry_wo(layout, static_cast<int>(i), static_cast<int>(count));
  };
  for (const MaterialFit& fit : brdf_->materials) {
    stand_for(fit.layout, fit.first_entry, fit.entry_count);
    for (const WidthSeries& s : fit.widths) stand_for(fit.layout, s.first_entry, s.entry_count);
  }
}

void GuidingCaches::prepare_materials() {
  std::vector<int> front(materials_.size(), -1);
  for (size_t i = 0; i < brdf_->materials.size(); ++i)
    if (brdf_->materials[i].material < materials_.size() && brdf_->materials[i].entry_count > 0)
      front[brdf_->materials[i].material] = static_cast<int>(i);
  for (const MaterialFit& fit : brdf_->materials)
    widths_.push_back(fit.widths.empty() || fit.material >= materials_.size()
                          ? std::nullopt
                          : lobe_width(materials_, static_cast<int>(fit.material)));
  for (size_t m = 0; m < materials_.size(); ++m) {
    const int behind = material_behind(materials_, static_cast<int>(m));
    fit_of_material_[m] = {front[m], behind >= 0 ? front[behind] : -1};
    uniform_[m] = {lobe_traits(materials_, static_cast<int>(m)).uniform,
                   behind >= 0 && lobe_traits(materials_, behind).uniform};
  }
}

FittedLobe GuidingCaches::brdf_lobe(int material, bool from_behind, const Vec3& wo,
                                    const Vec2& uv) const {
  if (material < 0 || !brdf_) return {};
  const int index = fit_of_material_[material][from_behind];
  if (index < 0) return {};
  const MaterialFit& fit = brdf_->materials[index];
  const EntrySeries series = nearest_series(fit, widths_[index] ? widths_[index]->at(uv) : 0);
  const int n = series.entry_count;
  const BrdfLobe& lobe = lobes_[series.first_entry + nearest_entry(fit.layout, wo, n)];
  if (lobe.mixture.count() == 0) return {};
  return {&lobe, entry_rotation(fit.layout, wo, lobe.wo, n)};
}

}  // namespace waylight
