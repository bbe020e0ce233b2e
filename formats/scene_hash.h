#pragma once

#include "libguide/scene/scene_description.h"

namespace waylight {

// Content hashes of the parts of a scene (XXH3), over values and not over names or file paths:
// textures by their pixels. The camera and the integrator's defaults are left out.
SceneHash hash_scene(const SceneDescription& scene);

}  // namespace waylight
