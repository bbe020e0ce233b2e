#pragma once
// Directions by what one cell of the illumination cache knows.

#include <optional>

#include "libguide/cache/guide_cache_view.h"
#include "libguide/directional/gaussian_product.h"
#include "libguide/math/frame.h"

namespace waylight {

// A density over directions: the cell's mixture, proportional to Li cos, its normalised product
// with a fitted BSDF, or the mean of the two. A sub-density: what falls outside the plane is a
// sample of value zero.
class CellGuide {
 public:
  CellGuide(const GuideCacheView& cache, const CacheCell& cell)
      : cell_(cell), frame_(cell.normal), light_(cache.mixture(cell)) {}
  CellGuide(const CellGuide&) = delete;
  CellGuide& operator=(const CellGuide&) = delete;

  // From now on the product with f, whose mixture stands on the disk of a frame of its own. Returns
  // the share of it that this guide can better than BSDF sampling: in lobes of f much narrower than
  // the cell can resolve, light is constant as far as the cell knows, and the product no more than
  // a fit of f. 0 also when the two do not overlap: neither sample() nor pdf() may be called then.
  float multiply(const GaussianMixture& f, const Mat3& to_world);

  // From now on the mean of f and the cell's mixture.
  void mix(const GaussianMixture& f, const Mat3& to_world) { carry(f, to_world), mixed_ = true; }

  std::optional<Vec3> sample(float u, const Vec2& u2) const;  // world space
  float pdf(const Vec3& wi) const {                           // per steradian
    const Vec2 y = direction_to_disk(frame_.to_local(wi));
    const float pdf = product_ ? product_->pdf(y)
                      : mixed_ ? 0.5f * (light_.pdf(y) + brdf_.pdf(y))
                               : light_.pdf(y);
    return pdf / kSteradianPerDiskArea;
  }
  float light_pdf(const Vec3& wi) const {  // of the mixture alone
    return light_.pdf(direction_to_disk(frame_.to_local(wi))) / kSteradianPerDiskArea;
  }

  float product_z() const { return product_ ? product_->z() : 0; }  // of the two as they are
  bool valid() const { return light_.count() > 0; }
  const CacheCell& cell() const { return cell_; }

 private:
  void carry(const GaussianMixture& f, const Mat3& to_world);  // into the cell's frame

  const CacheCell& cell_;
  Frame frame_;
  GaussianMixture light_;
  GaussianMixture brdf_;
  bool mixed_ = false;
  std::optional<GaussianProduct> product_;
};

}  // namespace waylight
