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

bool valid_density(const VmfComponent& c) {
  return c.weight > 0 && std::isfinite(c.weight) && c.kappa >= 0 && std::isfinite(c.kappa) &&
         std::abs(c.mean.squaredNorm() - 1) < 1e-3f;
}

template <typename Component>
std::string check_components(std::span<const Component> components, const char* lobe) {
  if (components.empty()) return {};
  if (components.size() > GaussianMixture::kMaxComponents)
    return fmt::format("{} components", components.size());
  double sum = 0;
  for (const Component& c : components) {
    if (!valid_density(c)) return fmt::format("a component is not a valid {}", lobe);
    sum += c.weight;
  }
  return std::abs(sum - 1) < 1e-3 ? std::string() : fmt::format("weights sum to {}", sum);
}

}  // namespace

std::string check_mixture(std::span<const GaussianComponent> components) {
  return check_components(components, "Gaussian");
}

std::string check_mixture(std::span<const VmfComponent> components) {
  return check_components(components, "von Mises-Fisher lobe");
}

}  // namespace waylight
