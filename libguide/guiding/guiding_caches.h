#pragma once
// The caches of one render, prepared for lookup by material and place.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "libguide/bsdf/textured_width.h"
#include "libguide/cache/guide_cache_view.h"
#include "libguide/guiding/cell_choices.h"
#include "libguide/guiding/medium_guides.h"
#include "libguide/records/brdf_cache.h"
#include "libguide/spatial/leaf_finder.h"

namespace waylight {

// What was fitted to f for one wo.
struct BrdfLobe {
  GaussianMixture mixture;
  Vec3 wo;            // in the frame of the entry
  float mean_cosine;  // of the mixture, to the normal that its frame stands on; not near 0

  BrdfLobe(std::span<const GaussianComponent> components, const Vec3& wo);
};

struct FittedLobe {
  const BrdfLobe* lobe = nullptr;      // null where there is no fit
  Mat3 to_shading = Mat3::Identity();  // rotation from the lobe's frame to the shading frame
};

class GuidingCaches {
 public:
  GuidingCaches() = default;
  // fits are asked for by load_fits() alone. What the spans and the view show must outlive this.
  // media: those that guide, none or all of the scene's.
  GuidingCaches(BrdfSource fits, const GuideCacheView& guide, std::span<const Material> materials,
                std::span<const Medium> media = {});

  bool may_load_fits() const { return static_cast<bool>(fits_); }
  void load_fits();  // where there are any
  void drop_fits();  // for good, and their memory if no one else has them
  bool has_fits() const { return brdf_ != nullptr; }

  bool guided() const { return !finder_.empty(); }
  // Whether a material scatters into more than single directions on either side.
  bool may_guide(int material) const {
    return smooth_.empty() || (material >= 0 && smooth_[material]);
  }
  const GuideCacheView& guide() const { return guide_; }
  // The cell that holds a point of a surface; only where there are cells. What it knows is on its
  // way from memory when this returns: do something else before it is asked for.
  uint32_t locate(const Vec3& position, const Vec3& normal) const {
    const uint32_t cell = finder_.find(position, normal);
    fetch_mixture(mixtures_[cell]);
    fetch(guide_.cells[cell]);
    if (!guide_.reaches.empty()) fetch(guide_.reaches[cell]);
    return cell;
  }
  const MediumGuides& media() const { return media_; }
  // What was fitted to f of the material for wo (shading frame, upper side), where its width is
  // textured for the nearest to the width at uv; empty when it has no fit. from_behind: the back of
  // a two-sided material is seen, which may have a fit of its own (material_behind).
  FittedLobe brdf_lobe(int material, bool from_behind, const Vec3& wo, const Vec2& uv) const;
  // Whether f is the same for all wi: its product with the light is the light.
  bool uniform(int material, bool from_behind) const {
    return material >= 0 && uniform_[material][from_behind];
  }

  // What was learned of a cell; `otherwise` as long as nothing has been.
  CellChoice choice(const CacheCell& cell, const CellChoice& otherwise) const {
    return choices_.empty() ? otherwise : choices_[index(cell)];
  }
  uint32_t index(const CacheCell& cell) const {
    return static_cast<uint32_t>(&cell - guide_.cells.data());
  }
  void learned(std::vector<CellChoice> choices) { choices_ = std::move(choices); }  // by cell

 private:
  // Begins to read an object: its first cache line and its last.
  template <typename T>
  static void fetch(const T& object) {
    __builtin_prefetch(&object);
    __builtin_prefetch(reinterpret_cast<const char*>(&object + 1) - 1);
  }
  // Most mixtures lie on three cache lines.
  static void fetch_mixture(uintptr_t address) {
    for (uintptr_t line = 0; line < 3; ++line)
      __builtin_prefetch(reinterpret_cast<const void*>(address + 64 * line));
  }

  void prepare_lobes();
  void prepare_materials();

  BrdfSource fits_;
  std::shared_ptr<const BrdfCache> brdf_;  // null: not loaded
  std::span<const Material> materials_;
  std::vector<BrdfLobe> lobes_;  // by brdf_->entries
  GuideCacheView guide_;
  LeafFinder finder_;
  std::vector<uintptr_t> mixtures_;  // where they lie, by cell
  MediumGuides media_;
  // By material, for its front and its back: index into brdf_->materials, or -1.
  std::vector<std::array<int, 2>> fit_of_material_;
  std::vector<std::array<bool, 2>> uniform_;
  std::vector<bool> smooth_;                      // by material; empty: not known
  std::vector<std::optional<LobeWidth>> widths_;  // by brdf_->materials; where textured
  std::vector<CellChoice> choices_;               // by cell; empty: not learned
};

}  // namespace waylight
