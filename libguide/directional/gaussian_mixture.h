#pragma once
// Bivariate Gaussian mixtures over the equal-area disk (math/warp.h).

#include <optional>
#include <span>

#include "libguide/math/fast_exp.h"
#include "libguide/math/types.h"
#include "libguide/math/warp.h"
#include "libguide/records/gaussian.h"

namespace waylight {

// Covariances whose smaller eigenvalue may be below this (det / trace is its bound from below) get
// it added to their diagonal: a standard deviation of 3e-4, a cone of 0.03 degrees. Narrower lobes
// are below what floats resolve at the rim of the disk.
inline constexpr float kCovarianceFloor = 1e-7f;

// Of means and variances of what counts as a Gaussian. The domain has radius sqrt(2), but a lobe
// that is carried over or fitted to a plateau may be wider.
inline constexpr float kMaxGaussianMagnitude = 1e6f;

// At most eight components in structure-of-arrays form, with what evaluation needs precomputed.
// The density is a sub-density of the domain |y|^2 <= 2: mass outside is lost, never renormalised,
// so a sample that falls outside is a sample of value zero.
class GaussianMixture {
 public:
  static constexpr int kMaxComponents = kLanes;

  GaussianMixture() = default;
  // Components without a positive weight, a finite place or a positive definite covariance are left
  // out, and so are those after the eighth; weights are normalised. With none left count() is 0,
  // the density zero and every sample empty.
  explicit GaussianMixture(std::span<const GaussianComponent> components);
  // The same after a rotation of the plane by the angle of (cosine, sine): a BRDF's mixture turned
  // to the azimuth of wo.
  GaussianMixture(std::span<const GaussianComponent> components, const Vec2& axis);

  float eval(const Vec2& y) const { return pdf(y); }
  std::optional<Vec2> sample(float u, const Vec2& u2) const;  // empty: outside the domain
  float pdf(const Vec2& y) const {                            // per unit area of the plane
    if (!(y.squaredNorm() <= kDiskMaxRadius2)) return 0;
    return lanes_sum(norm_ * exp2_clamped(-exponent(y.x(), y.y())));
  }

  int count() const { return count_; }
  GaussianComponent component(int i) const {
    return {weight_[i], mean_x_[i], mean_y_[i], cov_xx_[i], cov_xy_[i], cov_yy_[i]};
  }

  // The mixture on the disk of another hemisphere: each component carried over by frame_carry.h.
  // rotation: from this mixture's local frame to the other.
  GaussianMixture carried(const Mat3& rotation) const;

 private:
  friend class GaussianProduct;

  void fill(std::span<const GaussianComponent> components);
  void fill_valid(std::span<const GaussianComponent> components);
  IntLanes valid() const;
  void rotate(float cosine, float sine);
  void prepare();

  // log2(e) / 2 of the squared Mahalanobis distance, by the inverse Cholesky factor: the quadratic
  // form of the inverse covariance cancels for elongated lobes.
  Lanes exponent(float x, float y) const {
    const Lanes dx = x - mean_x_, dy = y - mean_y_;
    const Lanes a = dx * inverse_a_, b = (dy - slope_ * dx) * inverse_b_;
    return a * a + b * b;
  }

  int count_ = 0;
  // Unused lanes have weight 0 and unit covariance. Covariance = L L^T with
  // L = ((l_xx, 0), (slope l_xx, l_yy)).
  Lanes weight_{}, mean_x_{}, mean_y_{}, cov_xx_{}, cov_xy_{}, cov_yy_{};
  Lanes slope_{};
  Lanes inverse_a_{}, inverse_b_{};  // sqrt(log2(e) / 2) / l_xx and / l_yy
  Lanes norm_{};                     // weight / (2 pi l_xx l_yy)
  Lanes cumulative_{};               // sums of weight up to and including a lane
};

// The two standard normal numbers of a point of the unit square (Box-Muller).
Vec2 square_to_gaussian(const Vec2& u);

// The share of the mixture's mass with |y|^2 <= radius2, to about 1 % of each component's mass: by
// quadrature over 256 points of equal probability a component.
float mass_inside(const GaussianMixture& mixture, float radius2 = kDiskMaxRadius2);

}  // namespace waylight
