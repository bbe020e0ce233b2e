#pragma once
// Gaussians of one hemisphere's disk on the disk of another.

#include "libguide/math/lanes.h"
#include "libguide/math/types.h"
#include "libguide/records/gaussian.h"

namespace waylight {

// To first order: the mean goes through disk -> direction -> rotation -> disk, the covariance
// through the Jacobian J of that map, J Sigma J^T. Both maps are equal-area, so det J = 1 and the
// density at the mean is kept. A rotation about z is a planar rotation, exact for the whole lobe.
// Near the antipode of the new normal, where the plane tears, the map is held off the rim.
// rotation: from the local frame of the mixture to the other local frame.
GaussianComponent carry(const GaussianComponent& component, const Mat3& rotation);

// The same for eight components in place.
void carry(const Mat3& rotation, Lanes& mean_x, Lanes& mean_y, Lanes& cov_xx, Lanes& cov_xy,
           Lanes& cov_yy);

}  // namespace waylight
