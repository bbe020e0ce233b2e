#include "libguide/directional/gaussian_product.h"

namespace waylight {
namespace {

constexpr float kMinOverlap = 1e-20f;

// The product of two Gaussians with covariances A and B. In two dimensions the inverses need not be
// formed: (A^-1 + B^-1)^-1 = (|B| A + |A| B) / |A + B|, a sum of positive definite terms.
struct PairProduct {
  float mean_x, mean_y, xx, xy, det;

  PairProduct(const GaussianComponent& a, const GaussianComponent& b) {
    const double det_a = determinant(a.cov_xx, a.cov_xy, a.cov_yy);
    const double det_b = determinant(b.cov_xx, b.cov_xy, b.cov_yy);
    const double scale = 1 / determinant(static_cast<double>(a.cov_xx) + b.cov_xx,
                                         static_cast<double>(a.cov_xy) + b.cov_xy,
                                         static_cast<double>(a.cov_yy) + b.cov_yy);
    xx = static_cast<float>((det_b * a.cov_xx + det_a * b.cov_xx) * scale);
    xy = static_cast<float>((det_b * a.cov_xy + det_a * b.cov_xy) * scale);
    det = static_cast<float>(det_a * det_b * scale);
    // mean = mu_a + (A adj(B) + |A| I) (mu_b - mu_a) / |A + B|; in double, for A adj(B) cancels.
    const double dx = static_cast<double>(b.mean_x) - a.mean_x;
    const double dy = static_cast<double>(b.mean_y) - a.mean_y;
    const double tx = b.cov_yy * dx - b.cov_xy * dy, ty = b.cov_xx * dy - b.cov_xy * dx;
    mean_x = static_cast<float>(a.mean_x + (a.cov_xx * tx + a.cov_xy * ty + det_a * dx) * scale);
    mean_y = static_cast<float>(a.mean_y + (a.cov_xy * tx + a.cov_yy * ty + det_a * dy) * scale);
  }

  static double determinant(double xx, double xy, double yy) { return xx * yy - xy * xy; }

  Vec2 sample(const Vec2& u) const {
    const Vec2 z = square_to_gaussian(u);
    const float inverse_xx = 1 / xx, dx = std::sqrt(xx) * z.x();
    return {mean_x + dx, mean_y + xy * inverse_xx * dx + std::sqrt(det * inverse_xx) * z.y()};
  }
};

}  // namespace

GaussianProduct::GaussianProduct(const GaussianMixture& first, const GaussianMixture& second)
    : rows_(first.count() <= second.count() ? first : second),
      lanes_(first.count() <= second.count() ? second : first) {
  Lanes scale{};  // the weights without their exponentials
  for (int i = 0; i < rows_.count_; ++i) {
    const GaussianComponent row = rows_.component(i);
    const Lanes xx = lanes_.cov_xx_ + row.cov_xx, xy = lanes_.cov_xy_ + row.cov_xy;
    const Lanes yy = lanes_.cov_yy_ + row.cov_yy;
    const Lanes dx = lanes_.mean_x_ - row.mean_x, dy = lanes_.mean_y_ - row.mean_y;
    const Lanes det = difference_of_products(xx, yy, xy, xy);
    const Lanes inverse = 1 / (xx * det);  // one division for two
    const Lanes inverse_xx = inverse * det, inverse_det = inverse * xx;
    // The squared distance by completed squares; as one quadratic form it would cancel.
    const Lanes across = dy - xy * inverse_xx * dx;
    const Lanes distance2 = dx * dx * inverse_xx + across * across * xx * inverse_det;
    const Lanes norm =
        (0.5f * kInvPi * row.weight) * lanes_.weight_ * lanes_sqrt(lanes_max(inverse_det, Lanes{}));
    scale += norm;
    weights_[i] = norm * exp_clamped(-0.5f * distance2);
    // Written a lane at a time, the vector could not be read back before all stores are done.
    row_sum_ = kLaneIndex == i ? lanes_sum_splat(weights_[i]) : row_sum_;
  }
  const float z = lanes_sum(row_sum_);
  if (!(z > kMinOverlap * lanes_sum(scale))) return;
  z_ = z;
  inverse_z_ = 1 / z;
}

float GaussianProduct::resolved_share(const GaussianMixture& of, float variance) const {
  const Lanes det = difference_of_products(of.cov_xx_, of.cov_yy_, of.cov_xy_, of.cov_xy_);
  const Lanes width = lanes_sqrt(lanes_max(det, Lanes{})) * (1 / variance);
  Lanes share = row_sum_;  // of the product by lobe of the mixture
  if (&of == &lanes_) {
    share = Lanes{};
    for (int i = 0; i < rows_.count_; ++i) share += weights_[i];
  }
  return lanes_sum(share * lanes_min(width, splat(1))) * inverse_z_;
}

std::optional<Vec2> GaussianProduct::sample(float u, const Vec2& u2) const {
  float target = u * z_;
  const int i = lanes_choose(row_sum_, target, rows_.count_);
  const int j = lanes_choose(weights_[i], target, lanes_.count_);
  const Vec2 y = PairProduct(rows_.component(i), lanes_.component(j)).sample(u2);
  if (!(y.squaredNorm() <= kDiskMaxRadius2)) return std::nullopt;
  return y;
}

}  // namespace waylight
