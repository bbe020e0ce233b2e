#pragma once
// Lobes that one width describes: fitted once, they serve any scene.

#include <span>
#include <string>
#include <vector>

#include "libguide/fit/fitted_series.h"

namespace waylight {

// roughconductor-ggx, roughconductor-beckmann, phong, ward. Without a diffuse part: how much of it
// there is would be a second dimension.
std::vector<std::string> family_names();

// A scene of one material of that name, white, whose width is textured over 0.005 .. 1.
SceneDescription family_scene(const std::string& name);

// The series of a fitted family over the widths of a material, or none where they do not serve it:
// where, somewhere among its widths, the error of the family's entries is in the mean over
// elevations more than twice `tolerance` above that for the family's own lobe.
std::vector<FittedSeries> family_series(const BrdfCache& family,
                                        std::span<const Material> materials, const PlannedFit& fit,
                                        float tolerance, uint64_t seed);

}  // namespace waylight
