#pragma once

#include <span>
#include <string>

#include "libguide/records/gaussian.h"
#include "libguide/records/vmf.h"

namespace waylight {

// What is wrong with a stored mixture, or an empty string: what passes has at most
// GaussianMixture::kMaxComponents, none of which that leaves out, and weights that sum to 1. One
// without components is valid.
std::string check_mixture(std::span<const GaussianComponent> components);
// The same of lobes over the sphere, for VmfMixture.
std::string check_mixture(std::span<const VmfComponent> components);

}  // namespace waylight
