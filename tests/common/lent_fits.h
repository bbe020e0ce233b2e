#pragma once
// Fits as a render asks for them, of those that a test holds.

#include "libguide/records/brdf_cache.h"

namespace waylight::testing {

// calls: how often they were asked for. Both must outlive the source.
inline BrdfSource lend(const BrdfCache& fits, int* calls = nullptr) {
  return [&fits, calls] {
    if (calls) ++*calls;
    return std::shared_ptr<const BrdfCache>(std::shared_ptr<void>(), &fits);
  };
}

}  // namespace waylight::testing
