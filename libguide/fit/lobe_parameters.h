#pragma once
// A mixture as a point of a space without bounds: every vector of parameters is a valid mixture.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "libguide/math/fast_exp.h"
#include "libguide/records/gaussian.h"

namespace waylight {

// Of each component: the logarithm of its weight up to a common addend (softmax), t of the mean
// t / sqrt(1 + |t|^2) inside the unit disk, and of the Cholesky factor ((l_xx, 0), (m l_yy, l_yy))
// of its covariance log(l_xx - floor), m, log(l_yy - floor).
inline constexpr int kComponentParameters = 6;

// Means are moved inside the disk where they are not.
Eigen::VectorXd parameters_of(std::span<const GaussianComponent> components);
std::vector<GaussianComponent> components_of(const Eigen::VectorXd& parameters);

// One component in the form that its density and derivatives are computed from.
struct ParameterGaussian {
  float weight, norm;  // norm = weight / (2 pi l_xx l_yy)
  float mean_x, mean_y, inverse_xx, shear, inverse_yy;
  float mean_x_by_tx, mean_by_cross, mean_y_by_ty;  // of the mean by t, a symmetric matrix
  float log_xx_by, log_yy_by;                       // of log l by its parameter

  // Whitened coordinates of a point, and weight times density there.
  struct At {
    Lanes a, b, density;
  };
  At at(Lanes x, Lanes y) const {
    const Lanes a = (x - mean_x) * inverse_xx, b = (y - mean_y) * inverse_yy - shear * a;
    return {a, b, norm * exp_clamped(-0.5f * (a * a + b * b))};
  }
  // d log(density) by the parameters but the first, which is left to the softmax.
  void log_derivatives(const At& at, Lanes (&d)[kComponentParameters]) const {
    const Lanes along = at.a - shear * at.b;
    const Lanes by_x = along * inverse_xx, by_y = at.b * inverse_yy;
    d[1] = by_x * mean_x_by_tx + by_y * mean_by_cross;
    d[2] = by_x * mean_by_cross + by_y * mean_y_by_ty;
    d[3] = (at.a * along - 1) * log_xx_by;
    d[4] = at.a * at.b;
    d[5] = (at.b * (at.b + shear * at.a) - 1) * log_yy_by;
  }
};

// result: one a component.
void unpack(const double* parameters, std::span<ParameterGaussian> result);

}  // namespace waylight
