#pragma once
// Stage: fewer components per mixture by Runnalls' greedy merging.

#include "libguide/records/brdf_cache.h"
#include "libguide/records/guide_cache.h"

namespace waylight {

struct CacheReduceOptions {
  float max_cost = 10;     // percent of the cost of collapsing to one component, 0..100
  int max_components = 8;  // 1..8; merging goes on past the limit until so few are left
  // Of light, instead of max_cost: what the photons of a cell cannot tell apart is merged.
  bool by_evidence = false;

  void validate() const;
};

struct MixtureReduction {
  size_t mixtures = 0;
  double components_before = 0, components_after = 0;  // means per mixture
  double mean_cost = 0;                                // percent
};

struct CacheReduceSummary : MixtureReduction {
  MixtureReduction media;  // two mixtures a cell, of indirect and of direct light
};

// Fits know no number of samples: max_cost holds.
BrdfCache reduce(BrdfCache cache, const CacheReduceOptions& options, CacheReduceSummary* summary);
// Training statistics are dropped: a reduced cache cannot be trained further.
GuideCache reduce(GuideCache cache, const CacheReduceOptions& options, CacheReduceSummary* summary);

}  // namespace waylight
