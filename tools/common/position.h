#pragma once

#include <optional>
#include <string>

#include "libguide/math/types.h"

namespace waylight {

// "x,y,z" as three finite numbers, or nothing.
std::optional<Vec3> parse_position(const std::string& text);

}  // namespace waylight
