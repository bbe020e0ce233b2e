#include "libguide/directional/frame_carry.h"

namespace waylight {
namespace {

// Means are held this far from the rim |y|^2 = 2 (the antipode of the normal), in units of 2 -
// |y|^2 before and of 1 + z after the rotation: the Jacobian is infinite there.
constexpr float kRimMargin = 0.02f;

struct Jacobian {
  Lanes xx, xy, yx, yy;
};

void transform_covariance(const Jacobian& j, Lanes& xx, Lanes& xy, Lanes& yy) {
  const Lanes a = j.xx * xx + j.xy * xy, b = j.xx * xy + j.xy * yy;  // first row of J Sigma
  const Lanes c = j.yx * xx + j.yy * xy, d = j.yx * xy + j.yy * yy;
  xx = a * j.xx + b * j.xy;
  xy = a * j.yx + b * j.yy;
  yy = c * j.yx + d * j.yy;
}

// One row of dD/dw R dU/dy, with `q` = 1 / sqrt(1 + z) after the rotation R.
void jacobian_row(const Mat3& r, int row, Lanes mean, Lanes q, const Lanes (&du)[3][2],
                  Lanes& out_x, Lanes& out_y) {
  const Lanes across = -0.5f * mean * q * q;  // d(w q)/dz; `mean` is w q
  Lanes direct[3];
  for (int k = 0; k < 3; ++k) direct[k] = q * r(row, k) + across * r(2, k);
  out_x = direct[0] * du[0][0] + direct[1] * du[1][0] + direct[2] * du[2][0];
  out_y = direct[0] * du[0][1] + direct[1] * du[1][1] + direct[2] * du[2][1];
}

}  // namespace

void carry(const Mat3& r, Lanes& mean_x, Lanes& mean_y, Lanes& cov_xx, Lanes& cov_xy,
           Lanes& cov_yy) {
  const Lanes x = mean_x, y = mean_y, radius2 = x * x + y * y;
  if (r(2, 2) >= 1 - 1e-6f) {
    mean_x = r(0, 0) * x + r(0, 1) * y;
    mean_y = r(1, 0) * x + r(1, 1) * y;
    const Lanes one = splat(1);
    transform_covariance({r(0, 0) * one, r(0, 1) * one, r(1, 0) * one, r(1, 1) * one}, cov_xx,
                         cov_xy, cov_yy);
    return;
  }
  // U: disk -> direction is (x s, y s, 1 - |y|^2) with s = sqrt(2 - |y|^2).
  const Lanes s = lanes_sqrt(lanes_max(2 - radius2, splat(kRimMargin)));
  const Lanes inverse_s = 1 / s;
  const Lanes w[3] = {x * s, y * s, 1 - radius2};
  const Lanes du[3][2] = {{s - x * x * inverse_s, -x * y * inverse_s},
                          {-x * y * inverse_s, s - y * y * inverse_s},
                          {-2 * x, -2 * y}};
  // D: direction -> disk is (w_x, w_y) q with q = (1 + w_z)^-1/2.
  const Lanes z = r(2, 0) * w[0] + r(2, 1) * w[1] + r(2, 2) * w[2];
  const Lanes q = 1 / lanes_sqrt(lanes_max(1 + z, splat(kRimMargin)));
  mean_x = (r(0, 0) * w[0] + r(0, 1) * w[1] + r(0, 2) * w[2]) * q;
  mean_y = (r(1, 0) * w[0] + r(1, 1) * w[1] + r(1, 2) * w[2]) * q;
  Jacobian j;
  jacobian_row(r, 0, mean_x, q, du, j.xx, j.xy);
  jacobian_row(r, 1, mean_y, q, du, j.yx, j.yy);
  transform_covariance(j, cov_xx, cov_xy, cov_yy);
}

GaussianComponent carry(const GaussianComponent& c, const Mat3& rotation) {
  Lanes mean_x = splat(c.mean_x), mean_y = splat(c.mean_y);
  Lanes xx = splat(c.cov_xx), xy = splat(c.cov_xy), yy = splat(c.cov_yy);
  carry(rotation, mean_x, mean_y, xx, xy, yy);
  return {c.weight, mean_x[0], mean_y[0], xx[0], xy[0], yy[0]};
}

}  // namespace waylight
