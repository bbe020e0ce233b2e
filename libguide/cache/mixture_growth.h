#pragma once

#include <span>

#include "libguide/directional/expectation_maximization.h"

namespace waylight {

// EM only ever loses components. Splits those that spread their mass most, weight times largest
// eigenvalue, until there are `wanted`; the arrays have that much room. Each split keeps weight,
// mean and covariance of the two together: with sigma e the principal axis, the halves stand at
// mu -+ sigma e / 2 and have covariance Sigma - sigma^2 e e^T / 4. Returns the count.
size_t grow_mixture(std::span<GaussianComponent> components,
                    std::span<ComponentStatistics> statistics, size_t count, size_t wanted);

}  // namespace waylight
