#pragma once
// The caches of one render, prepared for lookup by material and place.

#include <span>
#include <vector>

#include "libguide/cache/guide_cache_view.h"
#include "libguide/records/brdf_cache.h"

namespace waylight {

class GuidingCaches {
 public:
  GuidingCaches() = default;
  // brdf may be null; both must outlive this.
  GuidingCaches(const BrdfCache* brdf, const GuideCacheView& guide, size_t material_count);

  bool guided() const { return !guide_.cells.empty(); }
  const GuideCacheView& guide() const { return guide_; }
  // Components fitted to f of the material at cos_theta of wo; empty when it has no fit.
  std::span<const GaussianComponent> brdf_lobes(int material, float cos_theta) const;
  bool has_fits() const { return brdf_ != nullptr; }

 private:
  const BrdfCache* brdf_ = nullptr;
  GuideCacheView guide_;
  std::vector<int> fit_of_material_;  // index into brdf_->materials, or -1
};

}  // namespace waylight
