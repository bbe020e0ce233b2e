#pragma once
// What Scene requires of a description, and the repairs that it makes before anything is built.

#include <string>
#include <vector>

#include "libguide/scene/scene_description.h"

namespace waylight {

// Throws Error where indices between the parts of the description do not fit, where an area light
// stands on an instanced shape, or where a sphere is not one. Prepares every mesh (mesh_prepare.h).
// Returns one sentence per repair.
std::vector<std::string> prepare_scene(SceneDescription& scene);

// Whether each instance is placed: one whose transform cannot be inverted is left out.
std::vector<bool> placed_instances(const SceneDescription& scene,
                                   std::vector<std::string>& warnings);

// Around all shapes and placed instances; corners that no triangle uses do not count.
Bounds shape_bounds(const Shape& shape);
Bounds scene_bounds(const SceneDescription& scene, const std::vector<bool>& placed);

}  // namespace waylight
