#include "libguide/directional/mixture_check.h"

#include <fmt/format.h>

#include <cmath>

#include "libguide/directional/gaussian_mixture.h"
#include "libguide/directional/vmf_mixture.h"

namespace waylight {
namespace {

// Valid is what the mixture for sampling does not leave out.
template <typename Mixture, typename Component>
std::string check_components(std::span<const Component> components, const char* lobe) {
  if (components.empty()) return {};
  if (components.size() > Mixture::kMaxComponents)
    return fmt::format("{} components", components.size());
  if (Mixture(components).count() != static_cast<int>(components.size()))
    return fmt::format("a component is not a valid {}", lobe);
  double sum = 0;
  for (const Component& c : components) sum += c.weight;
  return std::abs(sum - 1) < 1e-3 ? std::string() : fmt::format("weights sum to {}", sum);
}

}  // namespace

std::string check_mixture(std::span<const GaussianComponent> components) {
  return check_components<GaussianMixture>(components, "Gaussian");
}

std::string check_mixture(std::span<const VmfComponent> components) {
  return check_components<VmfMixture>(components, "von Mises-Fisher lobe");
}

}  // namespace waylight
