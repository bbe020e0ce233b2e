#include "libguide/cache_reduce.h"

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/directional/gaussian_mixture.h"
#include "libguide/directional/gaussian_reduction.h"

namespace waylight {
namespace {

// Reduces the mixtures of `owners`, each with first_component and component_count, and lays their
// components out anew in the same order.
template <typename Owner>
void reduce_all(std::vector<Owner>& owners, std::vector<GaussianComponent>& components,
                const CacheReduceOptions& options, CacheReduceSummary* summary) {
  std::vector<ReductionResult> reduced(owners.size());
  parallel_for(owners.size(), [&](size_t i) {
    const std::span<const GaussianComponent> mixture(components.data() + owners[i].first_component,
                                                     owners[i].component_count);
    reduced[i] = reduce_mixture(mixture, options.max_cost, options.max_components);
  });
  std::vector<GaussianComponent> kept;
  CacheReduceSummary sums;
  for (size_t i = 0; i < owners.size(); ++i) {
    sums.mixtures += owners[i].component_count > 0;
    sums.components_before += owners[i].component_count;
    sums.components_after += reduced[i].components.size();
    sums.mean_cost += reduced[i].percent();
    owners[i].first_component = static_cast<uint32_t>(kept.size());
    owners[i].component_count = static_cast<uint32_t>(reduced[i].components.size());
    kept.insert(kept.end(), reduced[i].components.begin(), reduced[i].components.end());
  }
  components = std::move(kept);
  const double count = std::max<size_t>(sums.mixtures, 1);
  if (summary)
    *summary = {sums.mixtures, sums.components_before / count, sums.components_after / count,
                sums.mean_cost / count};
}

}  // namespace

void CacheReduceOptions::validate() const {
  require(max_cost >= 0 && max_cost <= 100, "--max-cost {}: must be within 0..100 percent",
          max_cost);
  require(max_components >= 1 && max_components <= GaussianMixture::kMaxComponents,
          "--max-components {}: must be within 1..8", max_components);
}

BrdfCache reduce(BrdfCache cache, const CacheReduceOptions& options, CacheReduceSummary* summary) {
  options.validate();
  reduce_all(cache.entries, cache.components, options, summary);
  return cache;
}

GuideCache reduce(GuideCache cache, const CacheReduceOptions& options,
                  CacheReduceSummary* summary) {
  options.validate();
  reduce_all(cache.cells, cache.components, options, summary);
  cache.statistics.clear();
  cache.training.clear();
  parallel_for(cache.cells.size(), [&](size_t i) {
    CacheCell& cell = cache.cells[i];
    const std::span<const GaussianComponent> mixture(cache.components.data() + cell.first_component,
                                                     cell.component_count);
    cell.guided_mass = mass_inside(GaussianMixture(mixture));
  });
  return cache;
}

}  // namespace waylight
