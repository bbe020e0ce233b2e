#pragma once
// The normalised product of two mixtures without forming it: density G_f(y) G_L(y) / Z.

#include <array>

#include "libguide/directional/gaussian_mixture.h"

namespace waylight {

// [Herholz et al. 2016, section 4] with the cost hint of the G_f G_L / Z form: K_f K_L scalar
// weights once, the covariance of the one chosen pair, K_f + K_L Gaussians per density.
// The mixtures must outlive the product. A factor of either cancels: only its shape counts.
class GaussianProduct {
 public:
  GaussianProduct(const GaussianMixture& first, const GaussianMixture& second);

  // False when the mixtures do not overlap, that is when Z is below 1e-20 of what it would be if
  // all means coincided: sample and pdf must not be called then; fall back to another density.
  bool valid() const { return z_ > 0; }
  float z() const { return z_; }
  // The share of the product that comes from lobes of one of its mixtures at least as wide as
  // `variance`, the square root of the determinant of their covariance; narrower ones count in
  // proportion. In [0, 1].
  float resolved_share(const GaussianMixture& of, float variance) const;

  float eval(const Vec2& y) const { return pdf(y); }
  std::optional<Vec2> sample(float u, const Vec2& u2) const;  // empty: outside the domain
  float pdf(const Vec2& y) const {                            // per unit area of the plane
    return rows_.pdf(y) * lanes_.pdf(y) * inverse_z_;
  }

 private:
  const GaussianMixture& rows_;  // the one with fewer components
  const GaussianMixture& lanes_;
  float z_ = 0, inverse_z_ = 0;
  std::array<Lanes, kLanes>
      weights_;  // pair (i, j) in lane j of row i, unnormalised; used rows only
  Lanes row_sum_{};
};

}  // namespace waylight
