#include "libguide/fit/lobe_parameters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libguide/directional/gaussian_mixture.h"

namespace waylight {
namespace {

constexpr double kMaxRadius = 0.98;   // of a mean that is taken in
constexpr double kMinWidth = 3.2e-4;  // sqrt(kCovarianceFloor), rounded up
// Of parameters that are exponents: beyond it the solver asks for a nonsense step, which the cost
// then refuses.
constexpr double kMaxLog = 30;

double bounded_exp(double v) { return std::exp(std::clamp(v, -kMaxLog, kMaxLog)); }

void pack(const GaussianComponent& c, double* p) {
  const double radius = std::hypot(c.mean_x, c.mean_y);
  const double inside = radius > kMaxRadius ? kMaxRadius / radius : 1;
  const double x = inside * c.mean_x, y = inside * c.mean_y;
  const double scale = 1 / std::sqrt(1 - x * x - y * y);
  const double l_xx = std::sqrt(std::max(c.cov_xx, kCovarianceFloor));
  const double l_yx = c.cov_xy / l_xx;
  const double l_yy = std::sqrt(std::max<double>(c.cov_yy - l_yx * l_yx, kCovarianceFloor));
  p[0] = std::log(std::max(c.weight, 1e-12f));
  p[1] = x * scale, p[2] = y * scale;
  p[3] = std::log(std::max(l_xx - kMinWidth, 0.01 * kMinWidth));
  p[4] = l_yx / l_yy;
  p[5] = std::log(std::max(l_yy - kMinWidth, 0.01 * kMinWidth));
}

void place(const double* p, ParameterGaussian& g) {
  const double s = 1 / std::sqrt(1 + p[1] * p[1] + p[2] * p[2]), s2 = s * s;
  g.mean_x = p[1] * s, g.mean_y = p[2] * s;
  g.mean_x_by_tx = s * (1 - s2 * p[1] * p[1]);
  g.mean_y_by_ty = s * (1 - s2 * p[2] * p[2]);
  g.mean_by_cross = -s * s2 * p[1] * p[2];
}

void shape(const double* p, ParameterGaussian& g) {
  const double free_xx = bounded_exp(p[3]), free_yy = bounded_exp(p[5]);
  const double l_xx = kMinWidth + free_xx, l_yy = kMinWidth + free_yy;
  g.inverse_xx = 1 / l_xx, g.inverse_yy = 1 / l_yy;
  g.shear = p[4];
  g.log_xx_by = free_xx / l_xx, g.log_yy_by = free_yy / l_yy;
  g.norm = 1 / (2 * std::numbers::pi * l_xx * l_yy);
}

GaussianComponent component_of(const ParameterGaussian& g) {
  const float l_xx = 1 / g.inverse_xx, l_yy = 1 / g.inverse_yy, l_yx = g.shear * l_yy;
  return {g.weight, g.mean_x, g.mean_y, l_xx * l_xx, l_xx * l_yx, l_yx * l_yx + l_yy * l_yy};
}

}  // namespace

void unpack(const double* parameters, std::span<ParameterGaussian> result) {
  double largest = parameters[0], sum = 0;
  for (size_t k = 0; k < result.size(); ++k)
    largest = std::max(largest, parameters[kComponentParameters * k]);
  for (size_t k = 0; k < result.size(); ++k)
    sum += std::exp(parameters[kComponentParameters * k] - largest);
  for (size_t k = 0; k < result.size(); ++k) {
    const double* p = parameters + kComponentParameters * k;
    place(p, result[k]);
    shape(p, result[k]);
    result[k].weight = std::exp(p[0] - largest) / sum;
    result[k].norm *= result[k].weight;
  }
}

Eigen::VectorXd parameters_of(std::span<const GaussianComponent> components) {
  Eigen::VectorXd parameters(kComponentParameters * components.size());
  for (size_t k = 0; k < components.size(); ++k)
    pack(components[k], parameters.data() + kComponentParameters * k);
  return parameters;
}

std::vector<GaussianComponent> components_of(const Eigen::VectorXd& parameters) {
  std::vector<ParameterGaussian> gaussians(parameters.size() / kComponentParameters);
  unpack(parameters.data(), gaussians);
  std::vector<GaussianComponent> components;
  for (const ParameterGaussian& g : gaussians) components.push_back(component_of(g));
  return components;
}

}  // namespace waylight
