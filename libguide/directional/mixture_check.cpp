#include "libguide/directional/mixture_check.h"

#include <fmt/format.h>

#include <cmath>

#include "libguide/directional/gaussian_mixture.h"

namespace waylight {
namespace {

// In double: the determinant of a narrow but valid covariance can cancel to zero in float.
bool valid_density(const GaussianComponent& c) {
  const double det = double{c.cov_xx} * c.cov_yy - double{c.cov_xy} * c.cov_xy;
  return c.weight > 0 && c.cov_xx > 0 && c.cov_yy > 0 && std::isfinite(c.weight) &&
         std::isfinite(c.mean_x) && std::isfinite(c.mean_y) && std::isfinite(det) && det > 0;
}

}  // namespace

std::string check_mixture(std::span<const GaussianComponent> components) {
  if (components.empty()) return {};
  if (components.size() > GaussianMixture::kMaxComponents)
    return fmt::format("{} components", components.size());
  double sum = 0;
  for (const GaussianComponent& c : components) {
    if (!valid_density(c)) return "a component is not a valid Gaussian";
    sum += c.weight;
  }
  return std::abs(sum - 1) < 1e-3 ? std::string() : fmt::format("weights sum to {}", sum);
}

}  // namespace waylight
