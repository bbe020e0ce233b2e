#pragma once

#include <string>

#include "libguide/records/guide_cache.h"

namespace waylight {

// What is wrong with the training part of a cache whose other parts passed check(), or an empty
// string: what passes can be trained further without a NaN or an overflow.
std::string check_training(const GuideCache& cache);

}  // namespace waylight
