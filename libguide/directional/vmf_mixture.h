#pragma once
// Mixtures of von Mises-Fisher lobes over the sphere.

#include <span>

#include "libguide/directional/vmf.h"

namespace waylight {

// At most eight lobes in structure-of-arrays form, with what evaluation needs precomputed. The
// domain is the whole sphere: no mass is lost and no sample fails.
class VmfMixture {
 public:
  static constexpr int kMaxComponents = kLanes;

  VmfMixture() = default;
  // Lobes without a positive weight, a unit mean or a finite concentration that is not negative are
  // left out, and so are those after the eighth; weights and means are normalised, concentrations
  // end at kMaxKappa. With none left count() is 0, the density zero (samples are uniform then).
  explicit VmfMixture(std::span<const VmfComponent> components);

  float eval(const Vec3& w) const { return pdf(w); }
  Vec3 sample(float u, const Vec2& u2) const;
  float pdf(const Vec3& w) const {  // per steradian; w unit
    return lanes_sum(norm_ * exp2_clamped(half_ * distance2(w)));
  }

  int count() const { return count_; }
  VmfComponent component(int i) const { return {weight_[i], mean(i), kappa_[i]}; }

 private:
  friend class FocusedMixture;
  friend class VmfConvolution;
  friend class VmfProduct;

  void fill(std::span<const VmfComponent> components);
  IntLanes valid() const;
  void prepare();

  Vec3 mean(int i) const { return {mean_x_[i], mean_y_[i], mean_z_[i]}; }
  Lanes distance2(const Vec3& w) const {
    const Lanes x = mean_x_ - w.x(), y = mean_y_ - w.y(), z = mean_z_ - w.z();
    return x * x + y * y + z * z;
  }

  int count_ = 0;
  // Unused lanes have weight 0.
  Lanes weight_{}, mean_x_{}, mean_y_{}, mean_z_ = splat(1), kappa_{};
  Lanes half_{}, norm_{};  // -log2(e) kappa / 2; weight c(kappa)
  Lanes dispersion_ = splat(1);
  Lanes cumulative_{};  // sums of weight up to and including a lane
};

}  // namespace waylight
