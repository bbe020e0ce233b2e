#pragma once

#include <string>

#include "libguide/records/brdf_cache.h"

namespace waylight {

// What is wrong with fitted BSDFs, or an empty string. Those that pass give a valid density for any
// material and elevation; the writer and the reader of files refuse all others.
std::string check(const BrdfCache& cache);

}  // namespace waylight
