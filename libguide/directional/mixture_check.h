#pragma once

#include <span>
#include <string>

#include "libguide/records/gaussian.h"
#include "libguide/records/vmf.h"

namespace waylight {

// What is wrong with a stored mixture, or an empty string: what passes has at most
// GaussianMixture::kMaxComponents, each a valid density, and weights that sum to 1. One without
// components is valid.
std::string check_mixture(std::span<const GaussianComponent> components);
// The same of lobes over the sphere: unit means, concentrations that are not negative.
std::string check_mixture(std::span<const VmfComponent> components);

}  // namespace waylight
