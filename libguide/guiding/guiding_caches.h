#pragma once
// The caches of one render, prepared for lookup by material and place.

#include <array>
#include <span>
#include <vector>

#include "libguide/bsdf/material.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/records/brdf_cache.h"

namespace waylight {

class GuidingCaches {
 public:
  GuidingCaches() = default;
  // brdf may be null; both must outlive this.
  GuidingCaches(const BrdfCache* brdf, const GuideCacheView& guide,
                std::span<const Material> materials);

  bool guided() const { return !guide_.cells.empty(); }
  const GuideCacheView& guide() const { return guide_; }
  // Components fitted to f of the material at cos_theta of wo; empty when it has no fit.
  // from_behind: the back of a two-sided material is seen, which may have a fit of its own
  // (material_behind).
  std::span<const GaussianComponent> brdf_lobes(int material, bool from_behind,
                                                float cos_theta) const;
  bool has_fits() const { return brdf_ != nullptr; }

 private:
  const BrdfCache* brdf_ = nullptr;
  GuideCacheView guide_;
  // By material, for its front and its back: index into brdf_->materials, or -1.
  std::vector<std::array<int, 2>> fit_of_material_;
};

}  // namespace waylight
