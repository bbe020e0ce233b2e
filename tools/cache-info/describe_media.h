#pragma once

#include <nlohmann/json_fwd.hpp>

#include "libguide/records/medium_cache.h"

namespace waylight {

// What the part of a cache that is of media holds.
nlohmann::ordered_json describe_media(const MediumCache& medium);

}  // namespace waylight
