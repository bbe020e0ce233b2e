#include "libguide/cache_reduce.h"

#include "libguide/base/error.h"
#include "libguide/base/parallel.h"
#include "libguide/directional/gaussian_mixture.h"
#include "libguide/directional/gaussian_reduction.h"
#include "libguide/directional/vmf_reduction.h"

namespace waylight {
namespace {

MergeLimit limit_of(double samples, int parameters, const CacheReduceOptions& options) {
  return options.by_evidence && samples > 0 ? MergeLimit::by_evidence(samples, parameters)
                                            : MergeLimit(options.max_cost);
}

ReductionResult reduce_one(std::span<const GaussianComponent> mixture, double samples,
                           const CacheReduceOptions& options) {
  return reduce_mixture(mixture, limit_of(samples, kGaussianParameters, options),
                        options.max_components);
}

VmfReductionResult reduce_one(std::span<const VmfComponent> mixture, double samples,
                              const CacheReduceOptions& options) {
  return reduce_vmf_mixture(mixture, limit_of(samples, kVmfParameters, options),
                            options.max_components);
}

double samples_of(const CacheCell& cell) { return cell.effective_samples; }
double samples_of(const MediumLight& light) { return light.effective_samples; }
double samples_of(const BrdfCacheEntry& /*entry*/) { return 0; }  // not known

// Reduces the mixtures of `owners`, each with first_component and component_count, and lays their
// components out anew in the same order.
template <typename Owner, typename Component>
MixtureReduction reduce_all(std::span<Owner* const> owners, std::vector<Component>& components,
                            const CacheReduceOptions& options) {
  std::vector<Reduction<Component>> reduced(owners.size());
  parallel_for(owners.size(), [&](size_t i) {
    const std::span<const Component> mixture(components.data() + owners[i]->first_component,
                                             owners[i]->component_count);
    reduced[i] = reduce_one(mixture, samples_of(*owners[i]), options);
  });
  std::vector<Component> kept;
  MixtureReduction sums;
  for (size_t i = 0; i < owners.size(); ++i) {
    sums.mixtures += owners[i]->component_count > 0;
    sums.components_before += owners[i]->component_count;
    sums.components_after += reduced[i].components.size();
    sums.mean_cost += reduced[i].percent();
    owners[i]->first_component = static_cast<uint32_t>(kept.size());
    owners[i]->component_count = static_cast<uint32_t>(reduced[i].components.size());
    kept.insert(kept.end(), reduced[i].components.begin(), reduced[i].components.end());
  }
  components = std::move(kept);
  const double count = std::max<size_t>(sums.mixtures, 1);
  return {sums.mixtures, sums.components_before / count, sums.components_after / count,
          sums.mean_cost / count};
}

template <typename Owner>
std::vector<Owner*> pointers_to(std::vector<Owner>& owners) {
  std::vector<Owner*> pointers;
  for (Owner& owner : owners) pointers.push_back(&owner);
  return pointers;
}

MixtureReduction reduce_media(MediumCache& medium, const CacheReduceOptions& options) {
  std::vector<MediumLight*> lights;
  for (MediumCell& cell : medium.cells) lights.insert(lights.end(), {&cell.indirect, &cell.direct});
  medium.statistics.clear();
  medium.training.clear();
  return reduce_all<MediumLight>(lights, medium.components, options);
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
  const std::vector<BrdfCacheEntry*> entries = pointers_to(cache.entries);
  const MixtureReduction reduction = reduce_all<BrdfCacheEntry>(entries, cache.components, options);
  if (summary) *summary = {reduction, {}};
  return cache;
}

GuideCache reduce(GuideCache cache, const CacheReduceOptions& options,
                  CacheReduceSummary* summary) {
  options.validate();
  const std::vector<CacheCell*> cells = pointers_to(cache.cells);
  const MixtureReduction reduction = reduce_all<CacheCell>(cells, cache.components, options);
  const MixtureReduction media = reduce_media(cache.medium, options);
  if (summary) *summary = {reduction, media};
  cache.statistics.clear();
  cache.training.clear();
  cache.sources.clear();
  parallel_for(cache.cells.size(), [&](size_t i) {
    CacheCell& cell = cache.cells[i];
    const std::span<const GaussianComponent> mixture(cache.components.data() + cell.first_component,
                                                     cell.component_count);
    cell.guided_mass = mass_inside(GaussianMixture(mixture));
  });
  return cache;
}

}  // namespace waylight
