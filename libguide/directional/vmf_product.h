#pragma once
// The normalised product of two von Mises-Fisher mixtures without forming it: f(w) g(w) / Z.

#include <array>

#include "libguide/directional/vmf_mixture.h"

namespace waylight {

// As GaussianProduct: K_f K_L scalar weights once, the lobe of the one chosen pair, K_f + K_L lobes
// per density. With kappa mean = kappa_i mean_i + kappa_j mean_j, a pair has
//   Z_ij = w_i w_j c(kappa_i) c(kappa_j) / c(kappa) e^-(kappa_i + kappa_j - kappa).
// The mixtures must outlive the product. A factor of either cancels: only its shape counts.
class VmfProduct {
 public:
  VmfProduct(const VmfMixture& first, const VmfMixture& second);

  // False when the mixtures do not overlap, that is when Z is below 1e-20 of its sum without the
  // exponentials: sample and pdf must not be called then; fall back to another density.
  bool valid() const { return z_ > 0; }
  float z() const { return z_; }  // integral of the product of the two densities; 0 if not valid

  float eval(const Vec3& w) const { return pdf(w); }
  Vec3 sample(float u, const Vec2& u2) const;
  float pdf(const Vec3& w) const {  // per steradian
    return rows_.pdf(w) * lanes_.pdf(w) * inverse_z_;
  }

 private:
  const VmfMixture& rows_;  // the one with fewer lobes
  const VmfMixture& lanes_;
  float z_ = 0, inverse_z_ = 0;
  std::array<Lanes, kLanes> weights_;  // Z_ij in lane j of row i; used rows only
  Lanes row_sum_{};
};

}  // namespace waylight
